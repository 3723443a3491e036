//! How patterns vary: fresh offsets for scores, frozen and animated patterns for pictures.

use crate::support::edited::probe;
use crate::support::{self, still_life, variant_id};
use glam::{Quat, Vec3};
use std::collections::HashSet;
use umbrage_scene::Camera;
use umbrage_shadows::{Calibration, Renderer, Seeding, VariantId};

const FRAMES: u32 = 16;
const SEEDS: u32 = 8;
/// Blocks of 16 x 16 pixels in the test picture, whole ones only.
const BLOCKS: [u32; 2] = [still_life::SIZE.0 / 16, still_life::SIZE.1 / 16];

/// What a probe says at every pixel of a picture that a plane fills, per frame and seed.
fn pictures(body: &'static str, seeding: Seeding, patterns: &[[u32; 2]]) -> Vec<Vec<f32>> {
    let scene = still_life::of_geometry(still_life::plane(20.0, Quat::IDENTITY));
    let view = still_life::view_of(&Camera::look_at(Vec3::Y * 3.0, Vec3::ZERO, 0.8, 0.1, 40.0));
    let light = still_life::sun();
    let variant: VariantId = probe(variant_id("pcf-vogel-16-ign", Calibration::LightMatched), body);
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, &scene, 16).expect("fits");
    let mut picture = |&pattern: &[u32; 2]| {
        renderer.shade_frame(variant, (&view, &light), (seeding, pattern)).expect("runs").values
    };
    patterns.iter().map(&mut picture).collect()
}

const PHASE: &str = "return pattern_phase(floor(r.place) + 0.5);";
const PATTERN: &str = "return pattern(r.place, r.position);";

fn at(picture: &[f32], x: u32, y: u32) -> f32 {
    picture[(y * still_life::SIZE.0 + x) as usize]
}

fn frames_and_seeds() -> Vec<[u32; 2]> {
    (0..FRAMES).flat_map(|frame| (0..SEEDS).map(move |seed| [frame, seed])).collect()
}

/// The phase of every block, per frame and seed.
fn phases() -> Vec<Vec<f32>> {
    let blocks = || (0..BLOCKS[1]).flat_map(|y| (0..BLOCKS[0]).map(move |x| (16 * x, 16 * y)));
    let of = |picture: Vec<f32>| blocks().map(|(x, y)| at(&picture, x, y)).collect();
    pictures(PHASE, Seeding::Fresh, &frames_and_seeds()).into_iter().map(of).collect()
}

#[test]
fn a_fresh_phase_is_the_same_within_a_block_and_nowhere_else() {
    for picture in pictures(PHASE, Seeding::Fresh, &[[2, 5]]) {
        for (x, y) in (0..still_life::SIZE.1).flat_map(|y| (0..still_life::SIZE.0).map(move |x| (x, y))) {
            assert_eq!(at(&picture, x, y), at(&picture, x / 16 * 16, y / 16 * 16), "({x}, {y})");
        }
    }
    let all: Vec<u32> = phases().concat().iter().map(|p| p.to_bits()).collect();
    let distinct = all.iter().collect::<HashSet<_>>().len();
    // n draws of 24 bits collide n^2 / 2^25 times on average: 0.16 here, 6 in less than 1e-7 of all
    // hashes. A frame, seed or block that did not count would halve their number.
    assert!(distinct + 6 > all.len(), "{distinct} distinct phases of {}", all.len());
}

#[test]
fn fresh_phases_are_uniform() {
    const BINS: usize = 32;
    let all = phases().concat();
    let mut counts = [0f64; BINS];
    for phase in &all {
        assert!((0.0..1.0).contains(phase));
        counts[(phase * BINS as f32) as usize] += 1.0;
    }
    let expected = all.len() as f64 / BINS as f64;
    let chi_square: f64 = counts.iter().map(|n| (n - expected).powi(2) / expected).sum();
    // P(chi^2 > k + 2 sqrt(k x) + 2 x) <= exp(-x) (Laurent and Massart 2000, lemma 1): x = 14 makes
    // a uniform hash fail once in a million.
    let (degrees, x) = (BINS as f64 - 1.0, 14f64);
    let limit = degrees + 2.0 * (degrees * x).sqrt() + 2.0 * x;
    assert!(chi_square <= limit, "chi-square {chi_square}, limit {limit}");
}

#[test]
fn fresh_phases_of_neighbouring_frames_seeds_and_blocks_are_uncorrelated() {
    let all = phases();
    let block = |frame: u32, seed: u32, k: usize| f64::from(all[(frame * SEEDS + seed) as usize][k]) - 0.5;
    let blocks = all[0].len();
    let mut pairs = [Vec::new(), Vec::new(), Vec::new()];
    for (frame, seed) in (1..FRAMES).flat_map(|f| (1..SEEDS).map(move |s| (f, s))) {
        for k in 1..blocks {
            let here = block(frame, seed, k);
            pairs[0].push(here * block(frame - 1, seed, k));
            pairs[1].push(here * block(frame, seed - 1, k));
            pairs[2].push(here * block(frame, seed, k - 1));
        }
    }
    for (what, products) in ["frames", "seeds", "blocks"].into_iter().zip(pairs) {
        let count = products.len() as f64;
        let mean = products.iter().sum::<f64>() / count;
        // Two independent offsets from the middle: a product of mean 0 and deviation 1/12.
        let limit = 5.0 / 12.0 / count.sqrt();
        assert!(mean.abs() <= limit, "{what}: {mean}, limit {limit}");
    }
}

/// How many pixels of two pictures differ.
fn differing(a: &[f32], b: &[f32]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

#[test]
fn a_frozen_pattern_is_the_same_in_every_frame() {
    let all = pictures(PATTERN, Seeding::Frozen, &[[0, 0], [1, 0], [77, 0], [0, 3], [77, 3]]);
    let differences = [(0, 1), (0, 2), (3, 4)].map(|(a, b)| differing(&all[a], &all[b]));
    assert_eq!(differences, [0, 0, 0]);
}

#[test]
fn an_animated_pattern_moves_with_the_frame_and_repeats_after_64() {
    let all = pictures(PATTERN, Seeding::Animated, &[[0, 0], [1, 0], [64, 0]]);
    let frozen = &pictures(PATTERN, Seeding::Frozen, &[[0, 0]])[0];
    assert_eq!(differing(&all[0], frozen), 0, "frame 0 is the plain noise");
    assert!(differing(&all[0], &all[1]) > all[0].len() / 2, "the frame counts");
    assert_eq!(differing(&all[0], &all[2]), 0, "64 frames are a round");
}

#[test]
fn another_seed_turns_all_of_a_frozen_or_animated_pattern_by_one_angle() {
    for seeding in [Seeding::Frozen, Seeding::Animated] {
        let all = pictures(PATTERN, seeding, &[[5, 0], [5, 1], [5, 2]]);
        let turn = |seed: usize, pixel: usize| (all[seed][pixel] - all[0][pixel]).rem_euclid(1.0);
        for seed in [1, 2] {
            for pixel in 0..all[0].len() {
                // Two roundings of numbers below 2, round the circle.
                let apart = (turn(seed, pixel) - turn(seed, 0)).abs();
                assert!(apart.min(1.0 - apart) <= 4.0 * f32::EPSILON, "{seeding:?} {seed} {pixel}");
            }
        }
        let (first, second) = (turn(1, 0), turn(2, 0));
        assert!(first > 0.0 && second > 0.0 && first != second, "{seeding:?}: {first}, {second}");
    }
}
