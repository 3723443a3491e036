//! Truth fed through the scores as if it were a technique: it must come out right, at its own noise.

use crate::views::{frame_of, scene, view_of};
use umbrage_frame::Anchors;
use umbrage_metrics::{Bootstrap, Cells, Panel, PanelTruth, Quantity, TILE_PX, Tiling, cells, window_tiles};
use umbrage_reference::{GroundTruth, Method, Points, Tracer, TruthSettings};
use umbrage_scene::AreaLight;

/// Frames and seeds of the estimate that plays a technique.
const FRAMES: usize = 4;
const SEEDS: usize = 2;

struct Stage {
    anchors: Anchors,
    truth: PanelTruth,
    tiling: Tiling,
    points: Points,
    light: AreaLight,
    tracer: Tracer,
}

fn stage() -> Stage {
    let scene = scene("colonnade");
    let frame = frame_of(&scene, "P1", 60);
    let tracer = Tracer::new(&scene).expect("a tree of triangles");
    let hits = tracer.primary(&view_of(&frame, (160, 90)));
    let anchors = Anchors::of(&hits.gbuffer);
    let (points, light) = (hits.points(), frame.light);
    let GroundTruth { halves, basis, variance, facing, .. } =
        tracer.truth(&points, &light, &settings(1, 128, 1024));
    let truth = PanelTruth { frames: 1, halves, basis, variance };
    let tiling = Tiling::new(&anchors, &truth, &facing, TILE_PX).expect("tiles");
    Stage { anchors, truth, tiling, points, light, tracer }
}

fn settings(seed: u64, samples: u32, basis_samples: u32) -> TruthSettings {
    TruthSettings { samples, replicates: 8, basis_samples, seed, method: Method::Scanlines, tolerance: None }
}

impl Stage {
    fn score(&self, panel: &Panel) -> Cells {
        let table = window_tiles(panel, &self.truth, &self.tiling).expect("sums");
        cells(&[&table], &Bootstrap::default()).expect("scores")
    }

    /// Mean over the penumbra.
    fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        let points: Vec<u32> = self.tiling.tiles.iter().flat_map(|t| t.penumbra.clone()).collect();
        points.iter().map(|&p| value(p as usize)).sum::<f64>() / points.len() as f64
    }
}

fn value(cells: &Cells, quantity: Quantity) -> f64 {
    cells.get(quantity).value().unwrap_or_else(|| panic!("{quantity:?} is measured"))
}

/// A fresh estimate, from samples of its own, in each frame and seed: no bias, no motion, and noise
/// of the size that the estimates themselves state.
#[test]
fn a_third_estimate_of_truth_scores_its_own_noise_and_nothing_else() {
    let stage = stage();
    let points = stage.anchors.len();
    let mut panel = Panel { points, frames: FRAMES, seeds: SEEDS, values: Vec::new() };
    let mut stated = 0.0;
    for run in 0..FRAMES * SEEDS {
        let truth = stage.tracer.truth(&stage.points, &stage.light, &settings(100 + run as u64, 32, 0));
        stated += stage.mean(|p| f64::from(truth.variance[p])) / (FRAMES * SEEDS) as f64;
        panel.values.extend(truth.mean);
    }
    let scores = stage.score(&panel);
    let unbiased = [
        Quantity::SmoothStatic,
        Quantity::SmoothMoving,
        Quantity::StructuredStatic,
        Quantity::StructuredMoving,
        Quantity::Swimming,
        Quantity::Banding,
    ];
    for quantity in unbiased {
        let score = scores.get(quantity).score().expect("measured");
        // Six intervals of 95 %, twice as wide: beyond lie four standard errors. (Over 15 other seeds
        // SWIMMING averages 2e-7, and its interval misses 0 once.)
        let (down, up) = (2.0 * (score.value - score.low), 2.0 * (score.high - score.value));
        assert!(-up <= score.value && score.value <= down, "{quantity:?}: {score:?}");
        // And an interval that holds 0 because it is as wide as the noise would prove nothing.
        assert!(score.high - score.low < 0.5 * stated, "{quantity:?}: {score:?} beside noise of {stated}");
    }
    // Each of the two is a mean over thousands of points of variances with 7 and 4 degrees of freedom:
    // a few per cent. Catches a forgotten division by the number of halves (a factor of 2).
    let noise = value(&scores, Quantity::Noise);
    assert!((noise / stated - 1.0).abs() < 0.2, "noise {noise}, stated {stated}");
}

/// The mean of the halves against the halves: -(r1 - r2)^2 / 4 at each point, which is what a
/// reference that judges itself always gives; the scores print it as the reference's noise.
#[test]
fn truth_against_itself_is_minus_its_noise() {
    let stage = stage();
    let points = stage.anchors.len();
    let mean = (0..points).map(|p| stage.truth.mean(p) as f32).collect();
    let scores = stage.score(&Panel { points, frames: 1, seeds: 1, values: mean });
    let (mse, noise) = (value(&scores, Quantity::Mse), value(&scores, Quantity::ReferenceNoise));
    // The mean is rounded to f32: 3e-8 of a value times differences of halves of about 1e-2.
    assert!((mse + noise).abs() < 1e-9, "{mse} and {noise}");
    assert!(noise > 1e-7, "there is noise to speak of: {noise}");
    // One half against both: (r1 - r1)(r1 - r2) is 0 exactly.
    let half = stage.truth.halves[0].clone();
    let scores = stage.score(&Panel { points, frames: 1, seeds: 1, values: half });
    assert_eq!(value(&scores, Quantity::Mse), 0.0);
}

/// A constant c added to any panel adds c^2 + 2 c mean(e), all of it static and smooth: constants
/// are in every tile's smooth space.
#[test]
fn a_constant_lands_in_the_smooth_static_cell() {
    let stage = stage();
    let points = stage.anchors.len();
    let base: Vec<f32> = stage.truth.basis.iter().map(|g| 0.25 + 0.5 * g).collect();
    let shifted: Vec<f32> = base.iter().map(|v| v + 0.125).collect();
    let panel = |values| Panel { points, frames: 1, seeds: 1, values };
    let [before, after] = [base.clone(), shifted].map(|values| stage.score(&panel(values)));
    let error = stage.mean(|p| f64::from(base[p]) - stage.truth.mean(p));
    let expected = 0.125 * 0.125 + 2.0 * 0.125 * error;
    let gain = |quantity| value(&after, quantity) - value(&before, quantity);
    // 0.125 is exact; sums are rounded to f32 once per point (3e-8).
    assert!((gain(Quantity::Mse) - expected).abs() < 1e-7, "{} for {expected}", gain(Quantity::Mse));
    assert!((gain(Quantity::SmoothStatic) - expected).abs() < 1e-7);
    assert!(gain(Quantity::StructuredStatic).abs() < 1e-7);
}
