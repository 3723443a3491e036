//! Scanlines on a GPU against scanlines on the CPU: the same samples, the same answer.

use crate::agreement::{assert_ties_only, blocks, differences, large_soup, lights, low_sun, small_soup};
use crate::common::*;
use std::sync::OnceLock;
use umbrage_reference::{AdapterChoice, GpuTracer, GroundTruth, Method, Points, Share, Tracer, TruthGpu};
use umbrage_scene::AreaLight;

/// One for all tests: kernels are compiled once.
fn gpu() -> &'static TruthGpu {
    static GPU: OnceLock<TruthGpu> = OnceLock::new();
    let message = "these tests need a graphics adapter; a software one will do: \
                   apt-get install mesa-vulkan-drivers libvulkan1";
    GPU.get_or_init(|| TruthGpu::open(&AdapterChoice::default()).expect(message))
}

fn both(tracer: &Tracer, points: &Points, light: &AreaLight) -> ([GroundTruth; 2], Share) {
    let settings = settings(128, Method::Scanlines);
    let mut found = GpuTracer::new(tracer, gpu()).expect("it fits");
    let truth = found.truth(points, light, &settings).expect("the driver does it");
    ([tracer.truth(points, light, &settings), truth], found.share())
}

#[test]
fn blocks_on_a_floor() {
    let (tracer, points) = blocks();
    for light in lights().into_iter().chain([low_sun()]) {
        let (pair, share) = both(&tracer, &points, &light);
        println!("{light:?}: {share:?}");
        assert_ties_only(&format!("{light:?}"), &pair);
    }
}

#[test]
fn a_large_soup() {
    let (tracer, points) = large_soup();
    for light in lights() {
        let (pair, share) = both(&tracer, &points, &light);
        println!("{light:?}: {share:?}");
        assert_ties_only(&format!("{light:?}"), &pair);
    }
}

#[test]
fn three_hundred_soups() {
    let mut random = Random(12);
    let (mut points_in_all, mut differing, mut partial, mut cpu) = (0, 0, 0, 0);
    for soup in 0..300 {
        let (tracer, points) = small_soup(&mut random);
        let light = lights()[soup % 4];
        let (pair, share) = both(&tracer, &points, &light);
        let found = differences(&pair);
        assert!(found.iter().all(|&d| d <= 3), "soup {soup}, {light:?}: {found:?}");
        points_in_all += found.len();
        cpu += share.cpu;
        differing += found.iter().filter(|&&d| d > 0).count();
        partial += pair[0].mean.iter().filter(|&&m| m > 0.0 && m < 1.0).count();
    }
    println!("{differing} of {points_in_all} differ, {partial} in a penumbra, {cpu} on the CPU");
    assert!(partial > points_in_all / 20, "only {partial} of {points_in_all} in a penumbra");
    assert!(differing <= points_in_all / 200, "{differing} of {points_in_all} differ");
}

#[test]
fn standard_scenes() {
    for name in umbrage_scene::builtin_names() {
        let scene = umbrage_scene::Scene::builtin(name).expect("a standard scene");
        let tracer = Tracer::new(&scene).expect("a scene");
        let frames = &scene.paths[0].frames;
        let middle = &frames[frames.len() / 2];
        let points = tracer.primary(&view_of(&middle.camera, [64, 36])).points();
        let (pair, share) = both(&tracer, &points, &middle.light);
        let differing = differences(&pair);
        let count = differing.iter().filter(|&&d| d > 0).count();
        let worst = differing.iter().max().copied().unwrap_or(0);
        println!("{name}: {count} of {} differ, by up to {worst}; {share:?}", points.len());
        assert!(count <= points.len() / 100 && worst <= 3, "{name}: {count} differ, by up to {worst}");
    }
}
