//! The last pass of every variant, in both calibrations, under a sun and under local lights, over
//! pixels and over anchors.

use crate::case::{Case, Reading};
use crate::support::edited::all_variants;
use crate::support::{still_life, variant_id};
use umbrage_scene::AreaLight;
use umbrage_shadows::{Bias, Calibration, ConstantBias, ReceiverPlane, Seeding, VariantId};

/// Share of pixels whose result a rounding may decide. A position is known to about 2e-5 m, a
/// thousandth of a texel; a variant takes up to 160 decisions, and those at the borders of blockers
/// are near.
///
/// Not derived: the most found with lavapipe is 5.7 % (an acne-ridden plane under the sphere), and
/// the rest is slack. It admits that so many pixels take either outcome of their open decisions: an
/// error that only turns such decisions (a shift of less than 2e-5 m) escapes. All other pixels must
/// lie within their bounds, whatever this limit is; one outside of them fails. The limit guards the
/// twins: it catches bounds that have grown until they decide little. Tried: places known to a tenth
/// of a texel only leave 8.1 % of `pcf-grid-11` open and 12 % of `chss`, which fails; `hard`, with
/// its one decision, stays at 1 % and would not show it. Planted errors are judged without it: the least of them (80 for 70 in the
/// printed law, which saturates almost everywhere) puts 9 of 5184 pixels out of their bounds, half a
/// texel in the nearest tap 35, most others hundreds.
const OPEN_PIXELS: f64 = 0.08;
/// The same for anchors, which come without the rounding of depth and pose: at most 1.6 % are found,
/// the rest is slack. It would catch an anchor whose bound is as wide as a pixel's.
const OPEN_ANCHORS: f64 = 0.04;

fn check(case: &Case) {
    let ran = case.run();
    ran.compare_frame().check(&format!("{case:?}, pixels"), OPEN_PIXELS);
    // Where anchors are the pixel centres, both readings lie within the bounds of the same twin:
    // they are equal but for the rounding of the position.
    ran.compare_anchors().check(&format!("{case:?}, anchors"), OPEN_ANCHORS);
    ran.check_readings_agree();
}

/// Those whose twins carry bounds. All others have plain twins.
const BOUNDED: [&str; 7] =
    ["hard", "pcf-grid-11", "pcf-vogel-16", "pcf-vogel-16-ign", "chss", "chss-mask", "chss-min"];

fn is_bounded(variant: &VariantId) -> bool {
    BOUNDED.contains(&variant.variant.name)
}

fn check_all(light: AreaLight) {
    let bounded = all_variants().into_iter().filter(is_bounded);
    bounded.for_each(|variant| check(&Case::new(variant, light)));
}

/// Shares of results outside of plain bands, and of those that the receiver's own answer does not hold.
///
/// Not derived: the first is what unlucky roundings make (at most .004 were found with lavapipe), the
/// second guards the twins. What is left is strict: planted errors put 1 % to 60 % outside.
const PLAIN_LIMITS: [f64; 2] = [0.008, 0.08];

fn check_plain(light: AreaLight) {
    for variant in all_variants().into_iter().filter(|v| !is_bounded(v)) {
        if variant.check_light(&light).is_err() {
            continue;
        }
        let case = Case::new(variant, light);
        let ran = case.run();
        for reading in [Reading::Pixels, Reading::Anchors] {
            ran.compare_plain(reading).check(&format!("{case:?}, {reading:?}"), PLAIN_LIMITS);
        }
    }
}

#[test]
fn every_other_variant_equals_its_plain_twin_under_a_sun() {
    check_plain(still_life::sun());
}

#[test]
fn every_other_variant_equals_its_plain_twin_under_a_sphere() {
    check_plain(still_life::sphere());
}

#[test]
fn every_variant_equals_its_twin_under_a_sun() {
    check_all(still_life::sun());
}

#[test]
fn every_variant_equals_its_twin_under_a_sphere() {
    check_all(still_life::sphere());
}

#[test]
fn contact_hardening_equals_its_twin_under_a_disk() {
    for calibration in Calibration::ALL {
        check(&Case::new(variant_id("chss", calibration), still_life::disk()));
    }
}

#[test]
fn every_seeding_equals_its_twin() {
    let variant = variant_id("pcf-vogel-16-ign", Calibration::LightMatched);
    for (seeding, pattern) in [
        (Seeding::Fresh, [0, 0]),
        (Seeding::Frozen, [5, 1]),
        (Seeding::Animated, [5, 1]),
        (Seeding::Animated, [69, 0]),
    ] {
        check(&Case { seeding, pattern, ..Case::new(variant, still_life::sun()) });
    }
}

#[test]
fn every_kind_of_bias_equals_its_twin() {
    let normal_offset = Bias {
        constant: ConstantBias::World(0.0),
        normal_offset_texels: 1.5,
        receiver_plane: ReceiverPlane::Off,
    };
    let capped_plane = Bias {
        constant: ConstantBias::PerDistance(0.0005),
        normal_offset_texels: 0.4,
        receiver_plane: ReceiverPlane::On { max_slope: 0.6 },
    };
    for light in [still_life::sun(), still_life::sphere()] {
        for bias in [normal_offset, capped_plane] {
            for name in ["hard", "pcf-vogel-16"] {
                let variant = variant_id(name, Calibration::LightMatched);
                check(&Case { bias, ..Case::new(variant, light) });
            }
        }
    }
}
