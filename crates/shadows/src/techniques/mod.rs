//! Every technique and every variant. Adding a technique: its two files, a `mod` line and a line
//! here. Adding a variant: a line here.

mod chss;
mod chss_mask;
mod chss_min;
mod hard;
mod pcf_grid;
mod pcf_vogel;

use crate::Variant;

/// All variants in display order; each exists in both calibrations.
pub static VARIANTS: &[Variant] = &[
    Variant { name: "hard", technique: &hard::Hard },
    Variant { name: "pcf-grid-11", technique: &pcf_grid::PcfGrid { side: 11 } },
    Variant {
        name: "pcf-vogel-16",
        technique: &pcf_vogel::PcfVogel { taps: 16, rotation: pcf_vogel::Rotation::Fixed },
    },
    Variant {
        name: "pcf-vogel-16-ign",
        technique: &pcf_vogel::PcfVogel { taps: 16, rotation: pcf_vogel::Rotation::Ign },
    },
    Variant { name: "chss", technique: &chss::Chss { search_taps: 32, filter_taps: 16 } },
    Variant {
        name: "chss-mask",
        technique: &chss_mask::ChssMask { search_scale: 1.2, ..chss_mask::PRINTED },
    },
    Variant { name: "chss-min", technique: &chss_min::ChssMin { filter_taps: 16 } },
];
