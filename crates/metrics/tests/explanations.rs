//! What explains a score, on penumbrae of known shape and noise of known colour.

mod support;

use support::{Picture, Random};
use umbrage_metrics::{
    Bootstrap, Grain, Measurement, Missing, Panel, Profiles, SPECTRUM_FREQUENCIES, grain, profiles,
    window_grain, window_profiles,
};

const PICTURE: Picture = Picture { width: 256, height: 192 };
const BOOTSTRAP: Bootstrap = Bootstrap { seed: 1, replicates: 200, cluster_tiles: 2 };

/// A linear penumbra of `width` pixels along a turned edge; rows see all sub-pixel places.
fn edge(width: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| ((x + 0.3819 * y - 160.0) / width + 0.5).clamp(0.0, 1.0)
}

fn shape(truth: impl Fn(f64, f64) -> f64, panel: &Panel) -> Profiles {
    let truth = PICTURE.truth(truth, 0.0, 1);
    let tiling = PICTURE.tiling(&truth);
    let table = window_profiles(panel, &truth, &PICTURE.anchors(), &tiling).expect("a table");
    profiles(&[&table], &BOOTSTRAP)
}

fn value(measurement: Measurement) -> f64 {
    measurement.value().expect("measured")
}

#[test]
fn a_ramp_of_known_width_gives_the_ratio() {
    for ratio in [0.5, 1.0, 2.0] {
        let found = shape(edge(24.0), &PICTURE.panel(1, 1, |_, _, x, y| edge(24.0 * ratio)(x, y)));
        // Both areas count pixels: 192 rows of 19.2 px with ends at random places, +- 0.4 px a row,
        // / sqrt(192) / 19.2 = 0.15 % (0.3 % at ratio 0.5); four of them, rounded up.
        let width = value(found.width_ratio);
        assert!((width / ratio - 1.0).abs() < 0.02, "{ratio}: {width}");
    }
}

#[test]
fn noise_does_not_change_the_width_ratio() {
    let mut random = Random(2);
    let panel = PICTURE.panel(4, 4, |_, _, x, y| edge(48.0)(x, y) + 0.1 * random.normal());
    let found = shape(edge(24.0), &panel).width_ratio.score().expect("measured");
    // The mean of 16 deviates by 0.025: points within 0.025 of a limit change sides, as many in as
    // out, because the profile is linear there.
    assert!((found.value - 2.0).abs() < 0.04, "{found:?}");
    assert!(found.low < found.value && found.value < found.high);
}

#[test]
fn a_hard_shadow_has_no_width_and_one_step() {
    let panel = PICTURE.panel(1, 1, |_, _, x, y| if edge(24.0)(x, y) > 0.5 { 1.0 } else { 0.0 });
    let found = shape(edge(24.0), &panel);
    assert_eq!(value(found.width_ratio), 0.0);
    // All of the rise is in one increment, or in two neighbours that are put together.
    assert!((value(found.effective_levels) - 1.0).abs() < 0.05, "{:?}", found.effective_levels);
    assert!(value(found.plateau_fraction) > 0.9);
}

#[test]
fn width_that_depends_on_the_direction_is_anisotropy() {
    let both = |upright: f64, lying: f64| {
        move |x: f64, y: f64| {
            if y < 96.0 {
                ((x - 128.3) / upright + 0.5).clamp(0.0, 1.0)
            } else {
                ((y - 144.2) / lying + 0.5).clamp(0.0, 1.0)
            }
        }
    };
    let found = shape(both(20.0, 20.0), &PICTURE.panel(1, 1, |_, _, x, y| both(20.0, 30.0)(x, y)));
    // Edges along the grid: widths of 16 and 24 px are counted to one pixel, 6 %.
    let spread = value(found.width_anisotropy);
    assert!((spread - 0.5).abs() < 0.1, "{spread}");
    let one = shape(edge(24.0), &PICTURE.panel(1, 1, |_, _, x, y| edge(24.0)(x, y)));
    assert_eq!(one.width_anisotropy, Measurement::NotMeasured(Missing::OneEdgeAngle));
}

#[test]
fn a_staircase_has_its_levels_and_noise_is_no_staircase() {
    let smooth = edge(32.0);
    let mut random = Random(7);
    for levels in [4.0, 8.0] {
        let stairs = |x: f64, y: f64| ((smooth(x, y) * levels).floor() + 0.5) / levels;
        for noise in [0.0, 0.05] {
            let panel = PICTURE.panel(4, 4, |_, _, x, y| stairs(x, y) + noise * random.normal());
            let found = shape(&smooth, &panel);
            let counted = value(found.effective_levels);
            // Jumps closer than two bins in tiles that see few bins merge or split: "about K".
            assert!((counted / levels - 1.0).abs() < 0.2, "{levels} with noise {noise}: {counted}");
            assert!(value(found.plateau_fraction) > 0.7, "{:?}", found.plateau_fraction);
        }
    }
    let noisy = PICTURE.panel(4, 4, |_, _, x, y| smooth(x, y) + 0.05 * random.normal());
    let found = shape(&smooth, &noisy);
    // Sums of products of noise: 0.05 deviation over a dozen other seeds, four of them.
    let flat = value(found.plateau_fraction);
    assert!(flat.abs() < 0.2, "{flat}");
    let ratio = value(found.effective_levels) / value(found.resolvable_levels);
    assert!((ratio - 1.0).abs() < 0.2, "{ratio}");
}

/// A penumbra everywhere, so that noise is seen everywhere.
fn wide(x: f64, _: f64) -> f64 {
    0.25 + x / 512.0
}

fn grain_of(panel: &Panel) -> Grain {
    let truth = PICTURE.truth(wide, 0.0, 1);
    let table = window_grain(panel, &PICTURE.tiling(&truth)).expect("a table");
    grain(&[&table], &BOOTSTRAP)
}

/// A panel whose noise is `pattern(seed, x, y)` moved by `speed` pixels a frame.
fn moved(speed: f64, pattern: impl Fn(u64, f64, f64) -> f64) -> Panel {
    PICTURE.panel(4, 4, |t, s, x, y| wide(x, y) + pattern(s as u64, x + speed * t as f64, y))
}

fn white(seed: u64, x: f64, y: f64) -> f64 {
    0.1 * (Random::hash(&[seed, x as u64, y as u64]) - 0.5)
}

#[test]
fn noise_that_stays_correlates_and_noise_that_slides_does_not() {
    // Frozen on the screen, read at a fixed pixel; or slid by three pixels, read at a fixed point.
    let stays = grain_of(&moved(0.0, white)).lag1.score().expect("measured");
    assert!((stays.value - 1.0).abs() < 1e-6, "f32 rounding only: {stays:?}");
    let slides = grain_of(&moved(3.0, white)).lag1.score().expect("measured");
    // Standard error of a correlation over 49152 points x 3 free seeds (the three pairs of frames
    // see the same products): 2.6e-3, four of them.
    assert!(slides.value.abs() < 1.1e-2, "{slides:?}");
    let flips = PICTURE
        .panel(4, 4, |t, s, x, y| wide(x, y) + if t % 2 == 0 { 1.0 } else { -1.0 } * white(s as u64, x, y));
    assert!((value(grain_of(&flips).lag1) + 1.0).abs() < 1e-5);
}

#[test]
fn the_colour_of_noise_shows_after_a_blur() {
    let found = grain_of(&moved(0.0, white));
    // White noise keeps the centre of the squared kernel, 1 / (4 pi 2^2) = 0.0199 (a little more,
    // because lags end at 8 px); its spectrum is 1 everywhere.
    let left = value(found.after_blur);
    assert!((left / 0.0199 - 1.0).abs() < 0.1, "{left}");
    assert_eq!(found.spectrum.len(), SPECTRUM_FREQUENCIES.len());
    assert!(found.spectrum.iter().all(|p| (p - 1.0).abs() < 0.1), "{:?}", found.spectrum);
    let red = grain_of(&moved(0.0, |s, x, y| white(s, (x / 4.0).floor(), (y / 4.0).floor())));
    assert!(value(red.after_blur) > 5.0 * left);
    assert!(red.spectrum[0] > 3.0 && red.spectrum[15] < 0.5, "{:?}", red.spectrum);
    // White noise less its mean over the four neighbours: little is left at low frequencies.
    let blue = grain_of(&moved(0.0, |s, x, y| {
        let (x, y) = (x + 8.0, y + 8.0);
        let around =
            white(s, x + 1.0, y) + white(s, x - 1.0, y) + white(s, x, y + 1.0) + white(s, x, y - 1.0);
        white(s, x, y) - 0.25 * around
    }));
    assert!(value(blue.after_blur) < 0.3 * left, "{:?}", blue.after_blur);
    assert!(blue.spectrum[0] < 0.2 && blue.spectrum[15] > 1.0, "{:?}", blue.spectrum);
}

#[test]
fn without_noise_there_is_no_grain() {
    let still = grain_of(&PICTURE.panel(2, 2, |_, _, x, y| wide(x, y)));
    assert_eq!(still.lag1, Measurement::NotMeasured(Missing::NoNoise));
    assert!(still.spectrum.is_empty());
    let single = grain_of(&PICTURE.panel(2, 1, |_, _, x, y| wide(x, y)));
    assert_eq!(single.after_blur, Measurement::NotMeasured(Missing::OneSeed));
}
