//! Errors planted in the pipeline's WGSL, one at a time: the twins must notice each. This is what
//! makes their bounds and open decisions worth something.

use crate::case::{Case, Ran, Reading};
use crate::stages;
use crate::support::edited::{Edit, with_edit};
use crate::support::{still_life, variant_id};
use Calibration::{AsPrinted, LightMatched};
use std::panic::{AssertUnwindSafe, catch_unwind};
use umbrage_scene::AreaLight;
use umbrage_shadows::{Bias, Calibration, ConstantBias, ReceiverPlane};

/// A variant, a fragment, what stands there and what is put in its place.
type Plant = (&'static str, Calibration, &'static str, &'static str, &'static str);

fn case_of(plant: &Plant, light: AreaLight) -> Case {
    let &(name, calibration, fragment, from, to) = plant;
    Case::new(with_edit(variant_id(name, calibration), Edit { fragment, from, to }), light)
}

/// Many pixels, not one by luck.
fn notices(plant: &Plant, case: &Case) {
    let wrong = case.run().compare_frame().wrong.len();
    assert!(wrong >= 5, "{plant:?}: only {wrong} pixels differ");
}

const TAPS: &[Plant] = &[
    // Half a texel.
    ("hard", LightMatched, "tap", "floor(uv * MAP_TEXELS)", "floor(uv * MAP_TEXELS + 0.5)"),
    ("pcf-grid-11", LightMatched, "tap", "floor(uv * MAP_TEXELS)", "floor(uv * MAP_TEXELS + vec2(0.0, 0.5))"),
    ("pcf-vogel-16", LightMatched, "tap", "uv * MAP_TEXELS - 0.5", "uv * MAP_TEXELS"),
    ("pcf-vogel-16", AsPrinted, "tap", "uv * MAP_TEXELS - 0.5", "uv * MAP_TEXELS"),
    // A texel of the gather, and components in a wrong order: each pair once.
    ("pcf-vogel-16", AsPrinted, "tap", "(base + 1.0) / MAP_TEXELS", "(base + 2.0) / MAP_TEXELS"),
    ("pcf-vogel-16", AsPrinted, "tap", "mix(lit.w, lit.z", "mix(lit.z, lit.w"),
    ("pcf-vogel-16", AsPrinted, "tap", "mix(lit.x, lit.y", "mix(lit.y, lit.x"),
    (
        "pcf-vogel-16",
        AsPrinted,
        "tap",
        "mix(lit.w, lit.z, weight.x), mix(lit.x, lit.y",
        "mix(lit.x, lit.y, weight.x), mix(lit.w, lit.z",
    ),
    ("pcf-vogel-16", AsPrinted, "tap", "weight.x), weight.y)", "weight.y), weight.x)"),
    // References of other texels than the depths.
    ("pcf-vogel-16", LightMatched, "light_sun", "change.x, 0.0)", "change.y, 0.0)"),
    ("pcf-vogel-16", LightMatched, "tap", "(base + 0.5) / MAP_TEXELS - s.uv", "base / MAP_TEXELS - s.uv"),
    ("hard", LightMatched, "tap", "(texel + 0.5) / MAP_TEXELS - s.uv", "texel / MAP_TEXELS - s.uv"),
    ("hard", LightMatched, "tap", "pair.y <= pair.x", "pair.y - 0.1 <= pair.x"),
    // A map whose outside blocks.
    ("pcf-vogel-16", LightMatched, "tap", "select(1.0, mixed", "select(0.0, mixed"),
];

const KERNELS: &[Plant] = &[
    ("pcf-vogel-16", LightMatched, "kernel_vogel", "* 2.4", "* 2.5"),
    ("pcf-vogel-16", LightMatched, "kernel_vogel", "f32(i) + 0.5", "f32(i)"),
    (
        "pcf-vogel-16",
        LightMatched,
        "kernel_vogel",
        "vec2(cos(theta), sin(theta))",
        "vec2(sin(theta), cos(theta))",
    ),
    ("pcf-vogel-16-ign", LightMatched, "pcf_disc", "TAU * pattern", "pattern"),
    ("pcf-vogel-16-ign", LightMatched, "pattern_ign", "52.9829189", "50.0"),
    ("pcf-vogel-16-ign", LightMatched, "pattern_ign", "floor(place) + 0.5", "floor(place)"),
    ("pcf-vogel-16-ign", LightMatched, "seed_fresh", "/ 16u", "/ 8u"),
    ("pcf-vogel-16-ign", LightMatched, "seed_fresh", "globals.pattern_seed ^", "0u ^"),
    ("pcf-grid-11", LightMatched, "pcf_grid", "/ half_side", "/ f32(GRID_SIDE)"),
    ("pcf-grid-11", AsPrinted, "pcf_grid", "- half_side", "- 0.5 * f32(GRID_SIDE)"),
];

const LAWS: &[Plant] = &[
    ("chss", LightMatched, "blocker_search", "tally.x / tally.y,", "tally.x / f32(SEARCH_TAPS),"),
    ("chss", AsPrinted, "blocker_search", "pair.x < pair.y", "pair.x < s.depth"),
    ("chss", AsPrinted, "law_squared", "80.0", "70.0"),
    ("chss", AsPrinted, "law_squared", "80.0 * ratio * ratio", "80.0 * ratio"),
    (
        "chss",
        LightMatched,
        "law_light",
        "return true_radius_uv(receiver, blocker);",
        "return 2.0 * true_radius_uv(receiver, blocker);",
    ),
    ("pcf-vogel-16", LightMatched, "law_light", "globals.reference_gap", "2.0 * globals.reference_gap"),
    ("chss-min", LightMatched, "chss_min", "s.uv * size", "s.uv * size + 0.5"),
    ("chss-min", LightMatched, "fetch_bilinear", "place - 0.5", "place"),
    ("chss-mask", LightMatched, "chss_mask", "r.place / f32(MASK_STEP)", "(r.place + 0.5) / f32(MASK_STEP)"),
];

const BIASES: &[Plant] = &[
    ("hard", AsPrinted, "bias_constant", "- CONSTANT_BIAS_WORLD", ""),
    ("pcf-vogel-16", LightMatched, "bias_receiver_plane", "plane_quad(s, first, step)", "vec4(s.depth)"),
    ("chss-mask", LightMatched, "surface", "vec2<f32>(pixel) + 0.5", "vec2<f32>(pixel)"),
];

/// Errors that plain twins must notice, in moments of depth; at least one a technique.
const MOMENTS: &[Plant] = &[
    ("vsm", LightMatched, "chebyshev", "m.y - m.x * m.x", "m.y"),
    ("vsm", LightMatched, "moments_mips", "- 0.5;", ";"),
    ("vsm-listing", AsPrinted, "bound_listing", "depth - 0.02, depth", "depth, depth + 0.02"),
    ("vsm-filtered", LightMatched, "moments_mips", "MOMENTS_STEP * f32(1u << level)", "0.5 * MOMENTS_STEP"),
    ("vsm-lbr", LightMatched, "bound_reduced", " - BLEEDING) /", ") /"),
    ("vsm-mips", LightMatched, "vsm", "2.0 * fixed_radius_uv", "fixed_radius_uv"),
    ("vsm-sat", LightMatched, "moments_table", "corner - 1u", "corner"),
    ("vsm-sat", LightMatched, "vsm", "2.0 * fixed_radius_uv", "fixed_radius_uv"),
    ("vsm-search-mips", LightMatched, "moments_search", "m.x - lit * depth", "m.x - depth"),
    ("vsm-search-mips", LightMatched, "moments_search", "2.0 * SEARCH_SCALE", "SEARCH_SCALE"),
    ("vsm-search-sat", LightMatched, "vsm_search", "2.0 * kernel_radius_uv", "kernel_radius_uv"),
    ("vsm-guard", LightMatched, "moments_search", "lit > 0.99", "lit > 0.9"),
    ("vsm-poisson", LightMatched, "vsm_poisson", "* POISSON_RADIUS", ""),
    (
        "vsm-poisson",
        LightMatched,
        "vsm_poisson",
        "reference_depth(s, offset)",
        "reference_depth(s, vec2(0.0))",
    ),
    ("vsm-poisson-lod0", LightMatched, "vsm_poisson", "s.uv + offset", "s.uv - offset"),
    ("vsm-poisson-listing", LightMatched, "vsm_poisson", "search_radius_uv(s.depth)", "0.0"),
    (
        "vsm-search-pcf",
        LightMatched,
        "vsm_pcf",
        "kernel_radius_uv(s.depth, blocker)",
        "search_radius_uv(s.depth)",
    ),
    ("esm", LightMatched, "esm", "vec2(0.0)", "vec2(0.001)"),
    ("esm", LightMatched, "esm", "ESM_SHARPNESS * before_far", "0.9 * ESM_SHARPNESS * before_far"),
];

/// One result in a hundred outside of its band: the limit of the comparison is lower.
#[test]
fn in_moments() {
    for plant in MOMENTS {
        let bands = case_of(plant, still_life::sun()).run().compare_plain(Reading::Pixels);
        let share = bands.outside.len() as f64 / bands.compared as f64;
        assert!(share >= 0.01, "{plant:?}: only {share:.4} of the pixels differ");
    }
}

#[test]
fn in_taps() {
    TAPS.iter().for_each(|plant| notices(plant, &case_of(plant, still_life::sun())));
}

#[test]
fn in_kernels_and_patterns() {
    KERNELS.iter().for_each(|plant| notices(plant, &case_of(plant, still_life::sun())));
}

#[test]
fn in_laws() {
    LAWS.iter().for_each(|plant| notices(plant, &case_of(plant, still_life::sun())));
}

#[test]
fn in_biases() {
    BIASES.iter().for_each(|plant| notices(plant, &case_of(plant, still_life::sun())));
}

#[test]
fn in_the_normal_offset_and_the_plane() {
    let offset = Bias {
        constant: ConstantBias::World(0.0),
        normal_offset_texels: 1.5,
        receiver_plane: ReceiverPlane::Off,
    };
    let plane = Bias { receiver_plane: ReceiverPlane::On { max_slope: 5.0 }, ..offset };
    let (sun, sphere) = (still_life::sun(), still_life::sphere());
    // Without an offset only the constant keeps rounding from shadowing.
    let flush = Bias { constant: ConstantBias::World(0.001), normal_offset_texels: 0.0, ..plane };
    let plants: [(Bias, AreaLight, [&'static str; 3]); 7] = [
        (flush, sun, ["bias_receiver_plane", "- CONSTANT_BIAS_WORLD", ""]),
        (offset, sun, ["light_sun", "* length(n.xy)", ""]),
        (offset, sun, ["light_sun", "position + offset", "position - offset"]),
        (offset, sphere, ["light_local", "* texel_world * sine", "* texel_world"]),
        (plane, sun, ["light_sun", "vec2(n.x, -n.y)", "vec2(n.x, n.y)"]),
        (plane, sphere, ["light_local", "vec2(n.x, -n.y)", "vec2(n.x, n.y)"]),
        (plane, sphere, ["light_local", "/ receiver;", ";"]),
    ];
    for (bias, light, [fragment, from, to]) in plants {
        let plant = ("pcf-vogel-16", LightMatched, fragment, from, to);
        notices(&plant, &Case { bias, ..case_of(&plant, light) });
    }
}

#[test]
fn in_stages() {
    type Check = fn(&Ran);
    let plants: [(Plant, Check); 8] = [
        (("chss-mask", LightMatched, "penumbra_mask", "MASK_STEP / 2u", "0u"), stages::check_mask),
        (
            ("chss-mask", LightMatched, "penumbra_mask", "SEARCH_SCALE * largest", "largest"),
            stages::check_mask,
        ),
        (("chss-mask", AsPrinted, "penumbra_mask", "round(", "floor("), stages::check_mask),
        (("chss-mask", LightMatched, "seed_fresh", "pcg(PATTERN_SALT)", "pcg(0u)"), stages::check_mask),
        (("chss-mask", LightMatched, "blur_tile", "WEIGHT_3 * p3", "WEIGHT_2 * p3"), stages::check_mask_blur),
        (("chss-min", LightMatched, "min_shrink", "k / SHRINK", "k % SHRINK"), stages::check_min_map),
        (("chss-min", LightMatched, "min_axis", "k <= RADIUS", "k < RADIUS"), stages::check_min_map),
        (
            ("chss-min", LightMatched, "blur_tile", "group.xy * 8u) - 3", "group.xy * 8u) - 2"),
            stages::check_min_blur,
        ),
    ];
    for (plant, check) in plants {
        let ran = case_of(&plant, still_life::sun()).run();
        let noticed = catch_unwind(AssertUnwindSafe(|| check(&ran))).is_err();
        assert!(noticed, "{plant:?} was not noticed");
    }
}
