//! Other searches and other maps: errors that are planted in them, which their twins must notice.

use crate::case::{Case, Ran, Reading};
use crate::support::edited::{Edit, with_edit};
use crate::support::{still_life, variant_id};
use crate::twins::plain::{Spot, separable};
use umbrage_shadows::Calibration::{self, AsPrinted, LightMatched};

/// A variant, a fragment, what stands there and what is put in its place.
type Plant = (&'static str, Calibration, [&'static str; 3]);

const PLANTS: &[Plant] = &[
    ("chss-early-out", LightMatched, ["chss_early_out", "tally.y == f32(SEARCH_TAPS)", "tally.y >= 16.0"]),
    ("chss-early-out", LightMatched, ["chss_early_out", "tally.y == 0.0", "tally.y <= 6.0"]),
    (
        "chss-minmax",
        AsPrinted,
        ["early_bounds", "references.y <= bounds.depths.x", "references.x <= bounds.depths.y"],
    ),
    ("chss-mips", LightMatched, ["chss_mips", ">= 2.0 * FAR_TEXELS", ">= 1.0 * FAR_TEXELS"]),
    (
        "chss-mips",
        LightMatched,
        ["tap_level", "(texel + 0.5) * level_texel(level)", "texel * level_texel(level)"],
    ),
    ("chs", LightMatched, ["chs", "floor(place + 0.5) - 4.0", "floor(place + 0.5) - 2.0"]),
    ("chs", LightMatched, ["chs", "+ 0.5 - length", "+ 1.5 - length"]),
    ("chss-layers-2", LightMatched, ["chss_layers", "next < pair.y", "next < pair.x"]),
    (
        "chss-layers-4",
        LightMatched,
        ["chss_layers", "textureLoad(layer_2, texel", "textureLoad(layer_4, texel"],
    ),
    ("backprojection", LightMatched, ["backprojection", "c.y * flat + under_circle(c.x)", "c.y * flat"]),
    ("backprojection", LightMatched, ["light_patches", "cells.stride / 2", "cells.stride"]),
    ("backprojection-bits", LightMatched, ["backprojection_bits", "32u * word + bit", "bit"]),
];

/// Errors in the stages before the last pass of `sssm`: each stage's twin sees its own.
const SEPARABLE: &[[&str; 3]] = &[
    ["column", "2.0 * f32(k) / f32(GRID_SIDE - 1u)", "2.0 * f32(k) / f32(GRID_SIDE)"],
    ["sssm_search", "vec2(grid_offset(k, half), 0.0)", "vec2(0.0, grid_offset(k, half))"],
    ["sssm_radius", "tally.x / tally.y", "tally.x / f32(GRID_SIDE)"],
    ["plane_sun", "-dot(n.xy, across)", "dot(n.xy, across)"],
    ["sssm_filter", "vec2(grid_offset(k, half), 0.0)", "vec2(2.0 * grid_offset(k, half), 0.0)"],
];

/// Shares of pixels that differ from the twins of the three stages, all but 1 in 4 left out.
fn stages_apart(ran: &Ran) -> [f64; 3] {
    let light = ran.light();
    let plain = ran.plain(&light, 0);
    let (mut apart, mut compared) = ([0.0; 3], 0.0);
    for index in (0..ran.values.len() as u32).step_by(4) {
        let pixel = [index % still_life::SIZE.0, index / still_life::SIZE.0];
        let Some(receiver) = ran.surface(pixel) else { continue };
        let spot = Spot::of(&receiver);
        let at =
            |label: &str, channel: usize| f64::from(*ran.channels(label)[channel].at(pixel[0], pixel[1]));
        let [sum, count] = separable::searched(&plain, &spot);
        let found = [at("sssm-search-rows", 0), at("sssm-radius", 0), at("sssm-filter-rows", 0)];
        let expected = [sum, separable::radius(&plain, &spot), separable::filtered(&plain, &spot)];
        // Sums of metres, map widths (of which a texel is 2e-3), and shares of the light.
        let limits = [1e-4 * (1.0 + count), 1e-5, 5e-4];
        for k in 0..3 {
            apart[k] += f64::from(u8::from((found[k] - expected[k]).abs() > limits[k]));
        }
        compared += 1.0;
    }
    apart.map(|n| n / compared)
}

/// What unlucky roundings may decide, as for last passes (`variants::PLAIN_LIMITS`): no band is asked
/// for here.
const STAGE_LIMIT: f64 = 0.03;

#[test]
fn rows_and_radii_of_separable_shadows_equal_their_twins() {
    for light in [still_life::sun(), still_life::sphere()] {
        for calibration in Calibration::ALL {
            let apart = stages_apart(&Case::new(variant_id("sssm", calibration), light).run());
            assert!(apart.iter().all(|&a| a <= STAGE_LIMIT), "{light:?} {calibration:?}: {apart:?}");
        }
    }
}

#[test]
fn planted_errors_in_rows_and_columns_are_noticed() {
    for &[fragment, from, to] in SEPARABLE {
        let edited = with_edit(variant_id("sssm", LightMatched), Edit { fragment, from, to });
        let ran = Case::new(edited, still_life::sun()).run();
        let last = ran.compare_plain(Reading::Pixels);
        let last = last.outside.len() as f64 / last.compared as f64;
        let apart = stages_apart(&ran);
        let most = apart.iter().copied().fold(0.0, f64::max);
        assert!(most > 2.0 * STAGE_LIMIT || last > 0.01, "{from} was not noticed: {apart:?}, {last}");
    }
}

#[test]
fn planted_errors_are_noticed() {
    for &(name, calibration, [fragment, from, to]) in PLANTS {
        let edited = with_edit(variant_id(name, calibration), Edit { fragment, from, to });
        let bands = Case::new(edited, still_life::sun()).run().compare_plain(Reading::Pixels);
        // More than the share that unlucky roundings are granted (`variants::PLAIN_LIMITS`).
        let share = bands.outside.len() as f64 / bands.compared as f64;
        assert!(share > 0.01, "{name}: {from} was not noticed, {share:.4} are outside");
    }
}
