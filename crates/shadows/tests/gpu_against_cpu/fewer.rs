//! Targets with fewer pixels than the frame, a texel at a time: what a texel holds is what `chss`
//! says of the pixel that it stands for; and last passes that look back to where the camera was.

use crate::bands::Bands;
use crate::case::{Case, Ran, Reading};
use crate::support::edited::{Edit, with_edit};
use crate::support::{still_life, variant_id};
use crate::twins::plain::{Spot, fewer};
use glam::{Mat4, Vec3};
use std::panic::{AssertUnwindSafe, catch_unwind};
use umbrage_frame::View;
use umbrage_scene::{AreaLight, Camera};
use umbrage_shadows::{Calibration, Seeding};

/// Shares of results outside of their bands, and of those that need one: as for whole variants.
const LIMITS: [f64; 2] = [0.008, 0.08];

/// The camera of three frames ago up to now: each a step (a pixel and a half) from the next.
fn steps() -> Vec<View> {
    let camera = still_life::camera();
    let at = |age: u16| {
        let shift = Mat4::from_translation(Vec3::new(0.03, -0.01, 0.02) * f32::from(age));
        still_life::view_of(&Camera { world_from_camera: shift * camera.world_from_camera, ..camera })
    };
    [1, 2, 3].map(at).to_vec()
}

/// A variant in both calibrations under both lights, with a pattern that is the same in each frame.
fn cases(name: &str) -> Vec<Case> {
    let lights = [still_life::sun(), still_life::sphere()];
    let case = |c, light: AreaLight| Case {
        seeding: Seeding::Frozen,
        past: steps(),
        ..Case::new(variant_id(name, c), light)
    };
    lights.into_iter().flat_map(|light| Calibration::ALL.map(|c| case(c, light))).collect()
}

/// Every texel of a target against contact hardening at the pixel that it stands for. `stands_for`
/// gives the pixel and the place of its pattern.
fn check_texels(
    ran: &Ran,
    (label, age): (&str, usize),
    stands_for: impl Fn([i64; 2]) -> ([i64; 2], [f64; 2]),
) {
    let (light, mut bands) = (ran.light(), Bands::default());
    let plain = ran.plain(&light, 0);
    let is_tall =
        !matches!(ran.case.variant.variant.name, "checker-chss-plain" | "half-chss" | "three-quarter-chss");
    let image = ran.image(label);
    for (k, &value) in image.pixels().iter().enumerate() {
        let texel = [k as i64 % i64::from(image.width()), k as i64 / i64::from(image.width())];
        let (pixel, place) = stands_for(texel);
        let Some(receiver) = ran.surface_of(age, pixel.map(|c| c as u32)) else { continue };
        let angle = if is_tall { plain.tall_angle(place) } else { plain.angle(place) };
        bands.compare(value, &Spot { place, ..Spot::of(&receiver) }, |s| {
            vec![fewer::contact_hardening(&plain, s, angle)]
        });
    }
    bands.check(&format!("{:?}, {label}", ran.case), LIMITS);
}

fn centre(pixel: [i64; 2]) -> [f64; 2] {
    pixel.map(|c| c as f64 + 0.5)
}

/// Even rows hold even x, odd rows odd x, or the other way round.
fn unpacked([x, y]: [i64; 2], parity: i64) -> ([i64; 2], [f64; 2]) {
    let pixel = [2 * x + (y + parity) % 2, y];
    (pixel, centre(pixel))
}

#[test]
fn a_packed_texel_is_contact_hardening_at_its_pixel() {
    for name in ["checker-chss", "checker-chss-plain"] {
        cases(name).iter().for_each(|case| check_texels(&case.run(), ("lit-checker", 0), |t| unpacked(t, 0)));
    }
}

#[test]
fn a_target_of_every_pixel_is_contact_hardening() {
    let pixel = |texel| (texel, centre(texel));
    cases("whole-chss").iter().for_each(|case| check_texels(&case.run(), ("lit-whole", 0), pixel));
}

#[test]
fn a_flipping_checkerboard_computes_the_other_pixels_in_the_frame_before() {
    for case in cases("temporal-checker") {
        let ran = case.run();
        // The pattern's frame is 3.
        check_texels(&ran, ("lit-checker", 0), |t| unpacked(t, 1));
        check_texels(&ran, ("earlier-1-lit-checker", 1), |t| unpacked(t, 0));
    }
}

#[test]
fn a_smaller_targets_texel_is_contact_hardening_at_the_pixel_nearest_to_its_centre() {
    let view = still_life::view_of(&still_life::camera());
    for (name, scale) in [("half-chss", 0.5), ("three-quarter-chss", 0.75)] {
        let pixel = |texel| (fewer::nearest_pixel(&view, scale, texel), centre(texel));
        cases(name).iter().for_each(|case| check_texels(&case.run(), ("lit-low", 0), pixel));
    }
}

/// Which of the last four frames computed a pixel of the mask in frame 3: the cycle visits the first
/// of a quad, its opposite, then the two others.
fn age_of([x, y]: [u32; 2]) -> usize {
    match (x % 2, y % 2) {
        (0, 0) => 3,
        (1, 1) => 2,
        (1, 0) => 1,
        _ => 0,
    }
}

/// Every texel of the mask against the surface that its frame saw there.
fn check_mask(ran: &Ran) {
    let (light, mut bands) = (ran.light(), Bands::default());
    let (plain, mask) = (ran.plain(&light, 1), ran.image("penumbra-mask"));
    let stored = |share: f64| match ran.case.variant.calibration {
        Calibration::LightMatched => vec![share],
        // Eight bits, and either of two near a half.
        Calibration::AsPrinted => [-1e-3, 1e-3].map(|d| (share * 255.0 + d).round() / 255.0).to_vec(),
    };
    for (k, &radius) in mask.pixels().iter().enumerate() {
        let pixel = [k as u32 % mask.width(), k as u32 / mask.width()];
        let Some(receiver) = ran.surface_of(age_of(pixel), pixel) else {
            assert_eq!(radius, 0.0, "nothing is seen at {pixel:?}");
            continue;
        };
        let spot = Spot::of(&receiver);
        let Some(s) = plain.shadowed(&spot) else { continue };
        let share = (f64::from(radius) / plain.search(s.depth)) as f32;
        bands.compare(share, &spot, |s| stored(fewer::mask_share(&plain, s)));
    }
    bands.check(&format!("{:?}, mask", ran.case), LIMITS);
}

#[test]
fn an_interleaved_mask_holds_four_frames() {
    cases("temporal-mask").iter().for_each(|case| check_mask(&case.run()));
}

#[test]
fn a_blur_in_screen_space_starts_from_the_hard_shadow_and_the_seen_radius() {
    for case in cases("screen-blur") {
        let ran = case.run();
        let light = ran.light();
        let plain = ran.plain(&light, 0);
        let (mut lit, mut radii, mut rows) = (Bands::default(), Bands::default(), Bands::default());
        for k in 0..ran.values.len() {
            let pixel = [k as u32 % still_life::SIZE.0, k as u32 / still_life::SIZE.0];
            let Some(receiver) = ran.surface(pixel) else { continue };
            let (spot, hard) = (Spot::of(&receiver), ran.channels("lit-hard"));
            let angle = plain.angle(spot.place);
            let bilinear = |s: &Spot| plain.shadowed(s).map_or(1.0, |s| plain.bilinear(&s, [0.0; 2]));
            lit.compare(hard[0].pixels()[k], &spot, |s| vec![bilinear(s)]);
            // As shares of the most.
            radii.compare(hard[1].pixels()[k] / 32.0, &spot, |s| {
                vec![fewer::radius_pixels(&plain, s, angle) / 32.0]
            });
            rows.compare(ran.image("lit-rows").pixels()[k], &spot, |s| vec![fewer::row(&plain, s)]);
        }
        for (bands, what) in [(lit, "hard"), (radii, "radius"), (rows, "rows")] {
            bands.check(&format!("{:?}, {what}", ran.case), LIMITS);
        }
    }
}

const ALL: [&str; 11] = [
    "whole-chss",
    "checker-chss",
    "checker-chss-plain",
    "checker-chss-16bit",
    "checker-mask",
    "half-chss",
    "half-chss-bilateral",
    "three-quarter-chss",
    "temporal-checker",
    "temporal-mask",
    "screen-blur",
];

fn check_last_pass(case: &Case) {
    let ran = case.run();
    for reading in [Reading::Pixels, Reading::Anchors] {
        ran.compare_plain(reading).check(&format!("{case:?}, {reading:?}"), LIMITS);
    }
}

/// Cameras a step apart: pixels of a history lie between pixels.
#[test]
fn every_last_pass_equals_its_twin_under_a_camera_that_moves() {
    ALL.iter().flat_map(|name| cases(name)).for_each(|case| check_last_pass(&case));
}

/// A camera that stood far away, from where much was hidden.
#[test]
fn histories_equal_their_twins_after_a_jump() {
    let far = vec![still_life::view_of(&still_life::other_camera())];
    let jump = |case| Case { past: far.clone(), ..case };
    let histories = ["temporal-checker", "temporal-mask"].iter().flat_map(|name| cases(name));
    histories.map(jump).for_each(|case| check_last_pass(&case));
}

/// A variant, a calibration, a fragment, what stands there and what is put in its place.
type Plant = (&'static str, Calibration, &'static str, &'static str, &'static str);

const PLANTS: &[Plant] = &[
    ("checker-chss", Calibration::LightMatched, "checker", "is_computed(pixel,", "!is_computed(pixel,"),
    ("checker-chss", Calibration::AsPrinted, "weight_depth", "0.001 + abs", "0.1 + abs"),
    ("checker-chss", Calibration::AsPrinted, "fill_checker", "weighted.y < ZERO_BELOW", "weighted.y < 0.0"),
    (
        "checker-chss",
        Calibration::LightMatched,
        "weight_near",
        "length(there - position)",
        "0.1 * length(there - position)",
    ),
    (
        "half-chss-bilateral",
        Calibration::LightMatched,
        "weight_plane",
        "dot(r.normal, there - r.position)",
        "there.y - r.position.y",
    ),
    ("half-chss", Calibration::LightMatched, "low_res", "r.place * scale - 0.5", "r.place * scale"),
    ("three-quarter-chss", Calibration::AsPrinted, "low_res", "share * weight(", "share + 0.0 * weight("),
    (
        "temporal-checker",
        Calibration::LightMatched,
        "temporal_checker",
        "past.clip_from_world",
        "globals.clip_from_world",
    ),
    ("temporal-checker", Calibration::LightMatched, "temporal_checker", "<= AGREEMENT * depth", "<= depth"),
    ("temporal-checker", Calibration::LightMatched, "temporal_checker", "f32(parity)", "f32(1 - parity)"),
    ("screen-blur", Calibration::LightMatched, "screen_blur", "distance / radius", "0.5 * distance / radius"),
    ("screen-blur", Calibration::LightMatched, "half_disc", "1.0 - distance * distance", "1.0 - distance"),
];

/// Planted errors put more than the tolerated share outside.
#[test]
fn planted_errors_are_noticed() {
    for plant in PLANTS {
        let &(name, calibration, fragment, from, to) = plant;
        let variant = with_edit(variant_id(name, calibration), Edit { fragment, from, to });
        let far = vec![still_life::view_of(&still_life::other_camera())];
        let ran = Case { past: far, ..Case::new(variant, still_life::sun()) }.run();
        let bands = ran.compare_plain(Reading::Anchors);
        let share = bands.outside.len() as f64 / bands.compared as f64;
        assert!(share > LIMITS[0], "{plant:?}: only {share} outside");
    }
}

/// The same for what comes before the last pass.
#[test]
fn errors_planted_in_targets_are_noticed() {
    let noticed = |name: &str, [fragment, from, to]: [&'static str; 3], check: &dyn Fn(&Ran)| {
        let case = cases(name).remove(0);
        let ran = Case { variant: with_edit(case.variant, Edit { fragment, from, to }), ..case }.run();
        let failed = catch_unwind(AssertUnwindSafe(|| check(&ran))).is_err();
        assert!(failed, "{name}: {from} to {to} was not noticed");
    };
    // A frame of the cycle that is taken for another saw the pixel from elsewhere.
    let cycle = ["temporal_mask", "globals.frame_index & 3u", "(globals.frame_index + 1u) & 3u"];
    noticed("temporal-mask", cycle, &check_mask);
    let pixels = ["checkerboard", "2u * texel.x + odd", "2u * texel.x"];
    noticed("checker-chss", pixels, &|ran| check_texels(ran, ("lit-checker", 0), |t| unpacked(t, 0)));
}
