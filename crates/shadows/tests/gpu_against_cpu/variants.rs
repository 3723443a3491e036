//! The last pass of every variant, in both calibrations, under a sun and under local lights, over
//! pixels and over anchors.

use crate::case::Case;
use crate::support::edited::all_variants;
use crate::support::{still_life, variant_id};
use umbrage_scene::AreaLight;
use umbrage_shadows::{Bias, Calibration, ConstantBias, ReceiverPlane, Seeding, VariantId};

/// Share of results that a rounding may decide. A position is known to a few 1e-5 m (bounds, not
/// errors), a 1/500 of a texel; a variant takes up to 160 decisions and those at the borders of
/// blockers are near: 7 % of the pixels at most, 11 % where a search comes first, because each of
/// its decisions counts even if it hardly moves the mean. Anchors are exact: a third of it.
fn largest_open_share(variant: VariantId) -> f64 {
    if variant.variant.name == "chss" { 0.11 } else { 0.07 }
}

fn check(case: &Case) {
    let (ran, name) = (case.run(), case.variant.name());
    let limit = largest_open_share(case.variant);
    ran.compare_frame().check(&format!("{name}, {case:?}, pixels"), limit);
    // Where anchors are the pixel centres, both readings lie within the bounds of the same twin:
    // they are equal but for the rounding of the position.
    ran.compare_anchors().check(&format!("{name}, {case:?}, anchors"), 0.5 * limit);
    ran.check_readings_agree();
}

fn check_all(light: AreaLight) {
    all_variants().into_iter().for_each(|variant| check(&Case::new(variant, light)));
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
    for (seeding, pattern) in
        [(Seeding::Fresh, [0, 0]), (Seeding::Frozen, [5, 1]), (Seeding::Animated, [5, 1]), (Seeding::Animated, [69, 0])]
    {
        check(&Case { seeding, pattern, ..Case::new(variant, still_life::sun()) });
    }
}

#[test]
fn every_kind_of_bias_equals_its_twin() {
    let normal_offset =
        Bias { constant: ConstantBias::World(0.0), normal_offset_texels: 1.5, receiver_plane: ReceiverPlane::Off };
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
