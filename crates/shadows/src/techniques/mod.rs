//! Every technique and every variant. Adding a technique: its two files, a `mod` line and a line
//! here. Adding a variant: a line here.

mod backprojection;
mod checker;
mod chs;
mod chss;
mod chss_early_out;
mod chss_layers;
mod chss_mask;
mod chss_min;
mod chss_minmax;
mod chss_mips;
mod esm;
mod hard;
mod lerp;
mod low_res;
mod pcf_disc;
mod pcf_fetches;
mod pcf_grid;
mod pcss;
mod screen_blur;
mod sssm;
mod temporal_checker;
mod temporal_mask;
mod vsm;
mod vsm_pcf;
mod vsm_poisson;
mod vsm_search;

use crate::calibration::Law;
use crate::stages::Area;
use crate::stages::Grid;
use crate::{Projection, Variant};
use backprojection::{Backprojection, Hidden};
use checker::{Checker, Depths, Noise, Radius};
use chss_layers::{ChssLayers, Layers};
use chss_mask::{ChssMask, Searched, Smoothing, TapCount, WithoutBlocker};
use chss_min::{ChssMin, Empty};
use chss_minmax::{ChssMinmax, Output};
use esm::Esm;
use lerp::Base;
use low_res::{LowRes, Upsample};
use pcf_disc::{PcfDisc, Tap};
pub(crate) use pcf_disc::{Points, Rotation};
use pcf_grid::PcfGrid;
use pcss::{Mean, Pcss};
use vsm::{Bound, Vsm};
use vsm_pcf::VsmPcf;
use vsm_poisson::{Taps, VsmPoisson};
use vsm_search::VsmSearch;

/// All variants in display order; each exists in both calibrations.
#[rustfmt::skip] // a table: a line a variant
pub static VARIANTS: &[Variant] = &[
    // One comparison, or the four round it.
    Variant { name: "hard", technique: &hard::Hard { projection: Projection::Single } },
    Variant { name: "lerp", technique: &lerp::Lerp { base: Base::Mended } },
    Variant { name: "lerp-listing", technique: &lerp::Lerp { base: Base::Listing } },
    // A kernel of one size.
    Variant { name: "pcf-grid-3", technique: &PcfGrid { side: 3, tap: Tap::Point } },
    Variant { name: "pcf-grid-5", technique: &PcfGrid { side: 5, tap: Tap::Point } },
    Variant { name: "pcf-grid-11", technique: &PcfGrid { side: 11, tap: Tap::Point } },
    Variant { name: "pcf-grid-3-lerp", technique: &PcfGrid { side: 3, tap: Tap::Bilinear } },
    Variant { name: "pcf-poisson-16", technique: &PcfDisc { rotation: Rotation::Fixed, ..pcf_disc::POISSON_16 } },
    Variant { name: "pcf-poisson-64", technique: &PcfDisc { rotation: Rotation::Fixed, taps: 64, ..pcf_disc::POISSON_16 } },
    Variant { name: "pcf-poisson-16-hash", technique: &pcf_disc::POISSON_16 },
    Variant { name: "pcf-poisson-8-hash", technique: &PcfDisc { taps: 8, ..pcf_disc::POISSON_16 } },
    Variant { name: "pcf-poisson-16-ign", technique: &PcfDisc { rotation: Rotation::Ign, ..pcf_disc::POISSON_16 } },
    Variant { name: "pcf-vogel-16", technique: &pcf_disc::VOGEL_16 },
    Variant { name: "pcf-vogel-16-ign", technique: &PcfDisc { rotation: Rotation::Ign, ..pcf_disc::VOGEL_16 } },
    Variant { name: "pcf-vogel-16-white", technique: &PcfDisc { rotation: Rotation::White, ..pcf_disc::VOGEL_16 } },
    Variant { name: "pcf-vogel-32-ign", technique: &PcfDisc { rotation: Rotation::Ign, taps: 32, ..pcf_disc::VOGEL_16 } },
    Variant { name: "pcf-vogel-16-point-ign", technique: &PcfDisc { rotation: Rotation::Ign, tap: Tap::Point, ..pcf_disc::VOGEL_16 } },
    Variant { name: "pcf-vogel-64-point-ign", technique: &PcfDisc { rotation: Rotation::Ign, tap: Tap::Point, taps: 64, ..pcf_disc::VOGEL_16 } },
    Variant { name: "pcf-blue-16", technique: &PcfDisc { points: Points::Blue, ..pcf_disc::VOGEL_16 } },
    Variant { name: "pcf-blue-16-ign", technique: &PcfDisc { points: Points::Blue, rotation: Rotation::Ign, ..pcf_disc::VOGEL_16 } },
    Variant { name: "pcf-blue-32-ign", technique: &PcfDisc { points: Points::Blue, rotation: Rotation::Ign, taps: 32, ..pcf_disc::VOGEL_16 } },
    Variant { name: "pcf-spiral-8-ign", technique: &PcfDisc { points: Points::Spiral, rotation: Rotation::Ign, taps: 8, ..pcf_disc::VOGEL_16 } },
    // Contact hardening at full resolution.
    Variant { name: "chss", technique: &chss::CHSS },
    Variant { name: "chss-16", technique: &chss::Chss { search_taps: 16, ..chss::CHSS } },
    Variant { name: "chss-squared", technique: &chss::Chss { law: Law::Squared, ..chss::CHSS } },
    Variant { name: "chss-linear", technique: &chss::Chss { law: Law::Linear, ..chss::CHSS } },
    Variant { name: "chss-plane", technique: &chss::Chss { law: Law::Plane, ..chss::CHSS } },
    Variant { name: "chss-distance", technique: &chss::Chss { law: Law::Distance, ..chss::CHSS } },
    Variant { name: "pcss", technique: &pcss::MENDED },
    Variant { name: "pcss-listing", technique: &Pcss { law: Law::Depth01, ..pcss::MENDED } },
    Variant { name: "pcss-text", technique: &Pcss { mean: Mean::All, ..pcss::MENDED } },
    // The penumbra mask.
    Variant { name: "chss-mask", technique: &chss_mask::PRINTED },
    Variant { name: "chss-mask-raw-1.0", technique: &ChssMask { smoothing: Smoothing::Raw, search_scale: 1.0, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-raw-1.2", technique: &ChssMask { smoothing: Smoothing::Raw, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-1.0", technique: &ChssMask { search_scale: 1.0, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-1.4", technique: &ChssMask { search_scale: 1.4, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-1.6", technique: &ChssMask { search_scale: 1.6, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-1.8", technique: &ChssMask { search_scale: 1.8, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-depth-aware", technique: &ChssMask { smoothing: Smoothing::DepthAware, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-distance", technique: &ChssMask { smoothing: Smoothing::DistanceScaled, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-max", technique: &ChssMask { smoothing: Smoothing::MaxFirst, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-one", technique: &ChssMask { without_blocker: WithoutBlocker::Largest, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-one-1.0", technique: &ChssMask { without_blocker: WithoutBlocker::Largest, search_scale: 1.0, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-16", technique: &ChssMask { search_taps: 16, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-small-map", technique: &ChssMask { searched: Searched::Halved, ..chss_mask::PRINTED } },
    Variant { name: "chss-mask-few-taps", technique: &ChssMask { taps: TapCount::ByWidth, ..chss_mask::PRINTED } },
    // The minimum filter.
    Variant { name: "chss-min", technique: &chss_min::PRINTED },
    Variant { name: "chss-min-sharp", technique: &ChssMin { smoothing: chss_min::Smoothing::Raw, ..chss_min::PRINTED } },
    Variant { name: "chss-min-listing", technique: &ChssMin { empty: Empty::Near, ..chss_min::PRINTED } },
    // Other searches and other maps.
    Variant { name: "chss-early-out", technique: &chss_early_out::ChssEarlyOut },
    Variant { name: "chss-minmax", technique: &ChssMinmax { output: Output::Shadow } },
    Variant { name: "chss-mips", technique: &chss_mips::ChssMips },
    Variant { name: "chs", technique: &chs::Chs },
    Variant { name: "chss-layers-2", technique: &ChssLayers { layers: Layers::Two } },
    Variant { name: "chss-layers-4", technique: &ChssLayers { layers: Layers::Four } },
    Variant { name: "sssm", technique: &sssm::Sssm { side: 11 } },
    Variant { name: "backprojection", technique: &Backprojection { hidden: Hidden::Areas } },
    Variant { name: "backprojection-bits", technique: &Backprojection { hidden: Hidden::Bits } },
    // Fewer pixels.
    Variant { name: "whole-chss", technique: &Checker { grid: Grid::Whole, ..checker::LISTED } },
    Variant { name: "checker-chss", technique: &checker::LISTED },
    Variant { name: "checker-chss-plain", technique: &Checker { noise: Noise::Plain, ..checker::LISTED } },
    Variant { name: "checker-chss-16bit", technique: &Checker { depths: Depths::Bits16, ..checker::LISTED } },
    Variant { name: "checker-mask", technique: &Checker { radius: Radius::Mask, ..checker::LISTED } },
    Variant { name: "half-chss", technique: &low_res::HALF },
    Variant { name: "half-chss-bilateral", technique: &LowRes { upsample: Upsample::Bilateral, ..low_res::HALF } },
    Variant { name: "three-quarter-chss", technique: &LowRes { numerator: 3, denominator: 4, upsample: Upsample::Bilateral } },
    Variant { name: "temporal-checker", technique: &temporal_checker::TemporalChecker },
    Variant { name: "temporal-mask", technique: &temporal_mask::TemporalMask },
    Variant { name: "screen-blur", technique: &screen_blur::WIDEST_32 },
    // A map in every direction.
    Variant { name: "hard-cube", technique: &hard::Hard { projection: Projection::Cube } },
    Variant { name: "pcf-cube", technique: &PcfDisc { projection: Projection::Cube, ..pcf_disc::POISSON_16 } },
    Variant { name: "pcss-cube", technique: &Pcss { law: Law::Point, projection: Projection::Cube, ..pcss::MENDED } },
    // Moments of depth.
    Variant { name: "vsm", technique: &Vsm { area: Area::Texel, bound: Bound::Plain } },
    Variant { name: "vsm-listing", technique: &Vsm { area: Area::Texel, bound: Bound::Listing } },
    Variant { name: "vsm-soft", technique: &Vsm { area: Area::Texel, bound: Bound::Soft } },
    Variant { name: "vsm-filtered", technique: &Vsm { area: Area::Filtered, bound: Bound::Plain } },
    Variant { name: "vsm-lbr", technique: &Vsm { area: Area::Filtered, bound: Bound::Reduced } },
    Variant { name: "vsm-mips", technique: &Vsm { area: Area::Mips, bound: Bound::Plain } },
    Variant { name: "vsm-sat", technique: &Vsm { area: Area::Table, bound: Bound::Plain } },
    Variant { name: "vsm-search-mips", technique: &VsmSearch { area: Area::Mips, projection: Projection::Single } },
    Variant { name: "vsm-guard", technique: &VsmSearch { area: Area::Mips, projection: Projection::Guarded } },
    Variant { name: "vsm-search-sat", technique: &VsmSearch { area: Area::Table, projection: Projection::Single } },
    Variant { name: "vsm-poisson", technique: &VsmPoisson { taps: Taps::Matched } },
    Variant { name: "vsm-poisson-lod0", technique: &VsmPoisson { taps: Taps::Finest } },
    Variant { name: "vsm-poisson-listing", technique: &VsmPoisson { taps: Taps::Listing } },
    Variant { name: "vsm-search-pcf", technique: &VsmPcf { filter_taps: 16 } },
    Variant { name: "esm", technique: &Esm },
];

/// What a variant does on the way, as variants whose value is no shadow: for claims, never scored.
#[rustfmt::skip] // a table: a line a variant
pub static PROBES: &[Variant] = &[
    Variant { name: "chss-minmax-fetches", technique: &ChssMinmax { output: Output::Fetches } },
    Variant { name: "pcf-vogel-16-fetches", technique: &pcf_fetches::PcfFetches { taps: 16 } },
];
