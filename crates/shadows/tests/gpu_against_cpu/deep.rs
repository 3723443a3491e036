//! Other searches and other maps: errors that are planted in them, which their twins must notice.

use crate::case::{Case, Reading};
use crate::support::edited::{Edit, with_edit};
use crate::support::{still_life, variant_id};
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
