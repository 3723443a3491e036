//! `render --dump` and `reference`: what they write is enough to recompute a pixel by hand.

use crate::recompute::{Dump, Taps};
use std::path::Path;
use umbrage_frame::{Image, read_exr};
use umbrage_tests::{empty_folder, run, umbrage};

const TARGETS: [&str; 5] =
    ["shadow-map", "camera-depth", "camera-normal", "penumbra-mask", "penumbra-mask-blurred"];

fn dumped(folder: &Path) -> Dump {
    let line = "render colonnade --path P1 --frame 60 --variant chss-mask/light-matched --dump --size 128x72 \
                --map 512 --out frames";
    let ran = run(&mut umbrage(folder, line)).ended_with(0);
    let stem = "frames/chss-mask-light-matched.0060";
    for target in TARGETS {
        let name = format!("{stem}.{target}.exr");
        assert!(folder.join(&name).exists() && ran.stdout.contains(&name), "{name}");
    }
    Dump::read(folder, stem, "frames/matrices.0060.json")
}

/// The first seed document's way, from the dumped shadow map to the shadow, step by step.
#[test]
fn an_outsider_recomputes_the_mask_from_the_dump() {
    let folder = empty_folder();
    let dump = dumped(folder.path());
    the_blocker_search_follows_from_the_map(&dump);
    the_blur_follows_from_the_mask(&dump);
    the_shadow_follows_from_the_blurred_mask(&dump);
}

fn the_blocker_search_follows_from_the_map(dump: &Dump) {
    let (mut equal, mut penumbra, mut unclear) = (0, 0, 0);
    for y in 0..dump.mask.height() {
        for x in 0..dump.mask.width() {
            let Some(radius) = dump.searched_radius(x, y) else {
                unclear += 1;
                continue;
            };
            let stored = f64::from(*dump.mask.at(x, y));
            // Depths of 40 m rounded to f32 in light space, mean and difference: 8 roundings of 2e-6
            // m. Catches a tap more or less (a blocker 1 m off the mean moves it by 3 cm).
            let tolerance = 8.0 * 2e-6 * dump.radius_per_gap();
            assert!((radius - stored).abs() <= tolerance, "texel {x} {y}: {radius} is stored as {stored}");
            equal += 1;
            penumbra += usize::from(stored > 0.0);
        }
    }
    // Texels with a tap on the edge of a blocker may fall either way in f32, and prove nothing.
    assert!(
        penumbra >= 40 && equal >= 3 * unclear,
        "{equal} equal ({penumbra} with blockers), {unclear} unclear"
    );
}

fn the_blur_follows_from_the_mask(dump: &Dump) {
    // 7 taps, sigma 3, as the first document prints them.
    let weights = [0.106_595, 0.140_367, 0.165_569, 0.174_938, 0.165_569, 0.140_367, 0.106_595];
    let from = &dump.mask;
    let largest = f64::from(from.pixels().iter().fold(0f32, |a, &b| a.max(b)));
    let last = [i64::from(from.width()) - 1, i64::from(from.height()) - 1];
    let tap = |x: i64, y: i64| f64::from(*from.at(x.clamp(0, last[0]) as u32, y.clamp(0, last[1]) as u32));
    let reach = || (-3i64..=3).zip(weights);
    for y in 0..=last[1] {
        for x in 0..=last[0] {
            let row = |dy: i64| reach().map(|(dx, weight)| weight * tap(x + dx, y + dy)).sum::<f64>();
            let sum: f64 = reach().map(|(dy, weight)| weight * row(dy)).sum();
            let stored = f64::from(*dump.blurred.at(x as u32, y as u32));
            // 14 products and sums, each rounded to half an ulp. Catches a wrong weight or axis.
            let tolerance = 28.0 * largest * f64::from(f32::EPSILON);
            assert!((sum - stored).abs() <= tolerance, "texel {x} {y}: {sum} is stored as {stored}");
        }
    }
}

fn the_shadow_follows_from_the_blurred_mask(dump: &Dump) {
    let (mut grey, mut equal, mut unclear) = (0, 0, 0);
    for y in 0..dump.visibility.height() {
        for x in 0..dump.visibility.width() {
            match dump.filtered(x, y) {
                Taps::Unclear => unclear += 1,
                Taps::Lit(share) => {
                    let stored = f64::from(*dump.visibility.at(x, y));
                    // A tap that lies off by DRIFT texels an axis weighs its four texels differently
                    // by as much. Catches a wrong kernel radius, angle or weight: a lost tap is 1/16.
                    let tolerance = 2.0 * crate::recompute::DRIFT_TEXELS;
                    assert!(
                        (share - stored).abs() <= tolerance,
                        "pixel {x} {y}: {share} is stored as {stored}"
                    );
                    equal += 1;
                    grey += usize::from(stored > 0.05 && stored < 0.95);
                }
            }
        }
    }
    assert!(grey >= 100 && equal >= 3 * unclear, "{equal} equal ({grey} of them grey), {unclear} unclear");
}

#[test]
fn the_reference_is_written_with_its_layers() {
    check_reference("shafts", "rays");
    check_reference("scanlines", "scanline-rays");
}

/// A way and its arbiter.
fn check_reference(fast: &str, arbiter: &str) {
    let folder = empty_folder();
    for (method, out) in [(fast, "fast.exr"), (arbiter, "arbiter.exr")] {
        let line = format!(
            "reference colonnade --path P1 --frame 60 --size 96x54 --samples 64 --method {method} --out {out}"
        );
        let ran = run(&mut umbrage(folder.path(), &line)).ended_with(0);
        assert_eq!(ran.stdout.trim(), out);
    }
    let layers = read_exr(&folder.path().join("fast.exr")).expect("read");
    let layer = |name: &str| -> &Image<f32> {
        let found = layers.iter().find(|l| l.0 == name);
        &found.unwrap_or_else(|| panic!("no layer {name}")).1
    };
    for axis in ["X", "Y", "Z"] {
        let (normal, position) = (layer(&format!("normal.{axis}")), layer(&format!("position.{axis}")));
        assert!(normal.pixels().iter().chain(position.pixels()).all(|v| v.is_finite()));
    }
    let (mean, half1, half2) = (layer("reference.V"), layer("half1.V"), layer("half2.V"));
    for (pixel, &v) in mean.pixels().iter().enumerate() {
        assert!((0.0..=1.0).contains(&v), "V is a fraction: {v}");
        let halves = 0.5 * (half1.pixels()[pixel] + half2.pixels()[pixel]);
        // One rounding of the mean.
        assert!((v - halves).abs() <= f32::EPSILON, "{v} is not the mean of its halves, {halves}");
        assert!(layer("variance.V").pixels()[pixel] >= 0.0);
        assert!(layer("depth.Z").pixels()[pixel] >= 0.0);
    }
    assert!(mean.pixels().iter().filter(|v| **v > 0.1 && **v < 0.9).count() > 100, "there is a penumbra");
    // Both methods ask the same samples: they differ by samples on a silhouette at most.
    let rays = read_exr(&folder.path().join("arbiter.exr")).expect("read");
    let rays = &rays.iter().find(|l| l.0 == "reference.V").expect("V").1;
    let differing = rays.pixels().iter().zip(mean.pixels()).filter(|(a, b)| a != b).count();
    assert!(differing * 100 <= mean.pixels().len(), "{differing} pixels differ between {arbiter} and {fast}");
}

#[test]
fn more_samples_than_scanlines_hold_are_refused() {
    let folder = empty_folder();
    let line = "reference colonnade --size 16x9 --samples 8193 --method scanlines --out lines.exr";
    let ran = run(&mut umbrage(folder.path(), line)).ended_with(2);
    assert!(ran.stderr.contains("8193") && ran.stderr.contains("8192"), "{}", ran.stderr);
    assert!(!folder.path().join("lines.exr").exists());
}

#[test]
fn a_tolerance_is_reached_and_said() {
    let folder = empty_folder();
    let line = "reference colonnade --size 96x54 --samples 64 --tolerance 0.004 --out truth.exr";
    let ran = run(&mut umbrage(folder.path(), line)).ended_with(0);
    assert!(ran.stderr.contains("truth within 0.004"), "{}", ran.stderr);
    let layers = read_exr(&folder.path().join("truth.exr")).expect("read");
    let layer = |name: &str| layers.iter().find(|l| l.0 == name).expect(name).1.pixels().to_vec();
    let (samples, variance) = (layer("samples.V"), layer("variance.V"));
    // Few pixels need more than what all get; they get it, and then few miss the tolerance.
    let least = samples.iter().copied().filter(|&s| s > 0.0).fold(f32::INFINITY, f32::min);
    let refined = samples.iter().filter(|&&s| s > 2.0 * least).count();
    assert!(refined > 50 && refined < samples.len() / 2, "{refined} of {} refined", samples.len());
    let above = variance.iter().filter(|v| v.sqrt() > 0.004).count();
    assert!(above < refined / 4, "{above} above the tolerance, {refined} refined");
    for wrong in ["0", "1", "-0.1", "nan", "much"] {
        let line = format!("reference colonnade --size 16x9 --tolerance={wrong} --out no.exr");
        let ran = run(&mut umbrage(folder.path(), &line)).ended_with(2);
        assert!(ran.stderr.contains("between 0 and 1"), "{wrong}: {}", ran.stderr);
    }
}

#[test]
fn beauty_layers_are_written_when_bounces_are_asked_for() {
    let folder = empty_folder();
    let line =
        "reference colonnade --path P1 --size 32x18 --samples 16 --bounces 1 --beauty-samples 4 --out b.exr";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    let layers = read_exr(&folder.path().join("b.exr")).expect("read");
    let names: Vec<&str> = layers.iter().map(|l| l.0.as_str()).collect();
    for channel in ["R", "G", "B"] {
        assert!(names.iter().any(|n| n.rsplit('.').next() == Some(channel)), "no {channel} in {names:?}");
    }
}
