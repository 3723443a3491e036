//! FLIP and SSIM against independent packages; `peers/make_expected.py` made the expected numbers.

use glam::Vec3;
use umbrage_frame::{Image, ShadowMask};
use umbrage_metrics::{Bootstrap, MetricsError, Viewing, flip, ssim};

const EXPECTED: &str = include_str!("peers/expected.txt");

fn ramp(x: u32, y: u32) -> f64 {
    let t = ((f64::from(x) + 0.3 * f64::from(y) - 30.0) / 40.0).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn shown(x: u32, y: u32) -> f64 {
    let bands = (ramp(x, y) * 6.0).floor() / 6.0;
    (bands + f64::from((x * 73 + y * 179) % 101) / 101.0 * 0.2 - 0.1).clamp(0.0, 1.0)
}

fn masks() -> [ShadowMask; 2] {
    [ramp, shown].map(|of: fn(u32, u32) -> f64| Image::from_fn(96, 64, |x, y| of(x, y) as f32))
}

fn shaded(mask: &ShadowMask) -> Image<Vec3> {
    mask.map(|v| Vec3::splat(v * 0.75 + 0.125) * Vec3::new(0.8, 0.5, 0.25))
}

#[test]
fn ssim_is_that_of_scikit_image() {
    let [truth, test] = masks();
    let found = ssim(&truth, &test, &Bootstrap::default()).expect("a score");
    let expected: f64 =
        EXPECTED.lines().find_map(|l| l.strip_prefix("ssim ")).expect("a line").parse().expect("a number");
    // Both compute in doubles; 1e-4 admits another kernel radius rule (3.5 sigma), and catches a
    // sample covariance (factor 121/120).
    assert!((found.mean.value - expected).abs() < 1e-4, "{} {expected}", found.mean.value);
    assert_eq!((found.map.width(), found.map.height()), (86, 54));
}

#[test]
fn flip_is_that_of_flip_evaluator() {
    let [truth, test] = masks().map(|m| shaded(&m));
    for line in EXPECTED.lines().filter_map(|l| l.strip_prefix("flip ")) {
        let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().expect("a number")).collect();
        let viewing = Viewing { pixels_per_degree: numbers[0] as f32, exposure_stops: numbers[1] as f32 };
        let found = flip(&truth, &test, viewing, &Bootstrap::default()).expect("a score");
        // Single precision in both (1e-7 a pixel), different orders of summation.
        assert!((found.mean.value - numbers[2]).abs() < 1e-5, "{line}: {}", found.mean.value);
        assert!(found.mean.low <= found.mean.value && found.mean.value <= found.mean.high);
    }
}

#[test]
fn equal_pictures_are_equal_and_unequal_sizes_are_refused() {
    let [truth, _] = masks();
    let bootstrap = Bootstrap::default();
    // Each window's variances and covariance round alike, but not a * a and (2 a b) / 2: 1e-15.
    assert!((ssim(&truth, &truth, &bootstrap).expect("a score").mean.value - 1.0).abs() < 1e-7);
    let picture = shaded(&truth);
    assert_eq!(flip(&picture, &picture, Viewing::default(), &bootstrap).expect("a score").mean.value, 0.0);
    let small = Image::filled(10, 64, 0.5);
    assert!(matches!(ssim(&truth, &small, &bootstrap), Err(MetricsError::Length { .. })));
    assert!(matches!(ssim(&small, &small, &bootstrap), Err(MetricsError::TooSmall { .. })));
    let broken = picture.map(|_| Vec3::NAN);
    assert!(matches!(flip(&picture, &broken, Viewing::default(), &bootstrap), Err(MetricsError::Flip(_))));
}
