//! More samples where they are needed, and nothing biased by it.

use crate::common::*;
use glam::Vec3;
use umbrage_reference::{GroundTruth, Method, Points, Tracer, TruthSettings};
use umbrage_scene::AreaLight;

struct Court {
    tracer: Tracer,
    light: AreaLight,
    /// In a penumbra, by the truth of 16384 samples.
    points: Points,
    exact: Vec<f32>,
}

fn court(size: [u32; 2]) -> Court {
    let tracer = Tracer::new(&scene(&strewn_blocks())).expect("a scene");
    let light = AreaLight::Rect {
        centre: Vec3::new(2.1, 5.4, 1.6),
        half_u: Vec3::new(0.5, 0.1, 0.0),
        half_v: Vec3::new(0.0, 0.1, 0.3),
    };
    let all = tracer.primary(&view(Vec3::new(0.0, 5.0, 8.0), Vec3::ZERO, size)).points();
    let exact = tracer.truth(&all, &light, &plain(8192, 99)).mean;
    let chosen: Vec<usize> = (0..all.len()).filter(|&i| exact[i] > 0.004 && exact[i] < 0.996).collect();
    let points = Points {
        position: chosen.iter().map(|&i| all.position[i]).collect(),
        normal: chosen.iter().map(|&i| all.normal[i]).collect(),
        triangle: chosen.iter().map(|&i| all.triangle[i]).collect(),
    };
    let exact = chosen.iter().map(|&i| exact[i]).collect();
    Court { tracer, light, points, exact }
}

fn plain(samples: u32, seed: u64) -> TruthSettings {
    TruthSettings { seed, basis_samples: 0, ..settings(samples, Method::Scanlines) }
}

/// How much V is drawn towards 0 and 1, on average over the points.
fn pull(court: &Court, mean: &[f32]) -> f64 {
    let each = mean.iter().zip(&court.exact);
    each.map(|(m, e)| f64::from((m - e) * (e - 0.5).signum())).sum::<f64>() / mean.len() as f64
}

/// Mean over its standard error, of independent draws.
fn sigmas(draws: &[f64]) -> f64 {
    let n = draws.len() as f64;
    let mean = draws.iter().sum::<f64>() / n;
    let variance = draws.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0);
    mean / (variance / n).sqrt()
}

/// A pilot that is kept where its replicates agree draws V towards 0 and 1; one that is thrown away
/// does not. The truth of 16384 samples has errors of its own, a twentieth of those here, that do not
/// vary from draw to draw: they are below one sigma of 64 draws.
#[test]
fn refinement_does_not_bias() {
    let court = court([160, 90]);
    assert!(court.points.len() > 500);
    let truth = |settings| court.tracer.truth(&court.points, &court.light, &settings);
    let tolerance = 0.02;
    let (mut refined, mut kept) = (Vec::new(), Vec::new());
    for seed in 0..64 {
        let found = truth(TruthSettings { tolerance: Some(tolerance), ..plain(16, 2 * seed) });
        assert!(found.samples.iter().any(|&s| s > 100) && found.samples.contains(&32));
        refined.push(pull(&court, &found.mean));
        let (pilot, more) = (truth(plain(16, 2 * seed)), truth(plain(256, 2 * seed + 1)));
        let mixed: Vec<f32> = (0..court.points.len())
            .map(|i| if pilot.variance[i].sqrt() <= tolerance { pilot.mean[i] } else { more.mean[i] })
            .collect();
        kept.push(pull(&court, &mixed));
    }
    assert!(sigmas(&refined).abs() < 4.0, "refined: {:.1} sigma", sigmas(&refined));
    assert!(sigmas(&kept) > 6.0, "a kept pilot: {:.1} sigma", sigmas(&kept));
}

fn error(court: &Court, found: &GroundTruth) -> f64 {
    let squares = found.mean.iter().zip(&court.exact).map(|(m, e)| f64::from(m - e).powi(2));
    (squares.sum::<f64>() / found.mean.len() as f64).sqrt()
}

/// What is asked for is reached, with fewer samples than if all points got the most, and the error is
/// what the standard error says: the exact truth's own, a tenth of the tolerance, is lost in it.
#[test]
fn tolerance_is_reached() {
    let court = court([320, 180]);
    let truth = |settings| court.tracer.truth(&court.points, &court.light, &settings);
    let plain_one = truth(plain(128, 7));
    assert!(plain_one.reached(0.002).above > 0.5, "{:?}", plain_one.reached(0.002));
    let found = truth(TruthSettings { tolerance: Some(0.002), ..plain(128, 7) });
    let reached = found.reached(0.002);
    assert!(reached.rms < 0.002 && reached.above < 0.1, "{reached:?}");
    assert!(reached.samples < 8192.0 && reached.samples > 256.0, "{reached:?}");
    let error = error(&court, &found);
    // Of thousands of points whose errors are independent: the two agree within a few per cent, but for
    // the noise of the exact truth.
    assert!((0.85..1.2).contains(&(error / reached.rms)), "error {error}, {reached:?}");
}

/// What is good enough already is the truth without a tolerance, bit for bit.
#[test]
fn a_wide_tolerance_changes_nothing() {
    let court = court([96, 54]);
    for method in [Method::Scanlines, Method::Shafts] {
        let settings = TruthSettings { basis_samples: 64, ..settings(64, method) };
        let truth = |tolerance| {
            court.tracer.truth(&court.points, &court.light, &TruthSettings { tolerance, ..settings })
        };
        assert_eq!(truth(Some(1.0)), truth(None));
    }
}
