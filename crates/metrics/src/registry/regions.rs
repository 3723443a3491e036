//! Where else it is wrong, where it is worst, and how far the numbers can be trusted.

use super::Direction::{Descriptive, LowerIsBetter, TargetOne};
use super::{MetricInfo, UMBRAGE};

const SHARE: &str = "0 to 1";

pub(super) const LIGHT_LEAK: MetricInfo = MetricInfo {
    id: "light_leak",
    name: "Light leak",
    unit: "visibility",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "Mean light where the truth is full shadow.",
    formula: "mean of v over the umbra (g at most 1/512, more than a pixel away from any penumbra); of v - g where truth is each frame's own",
    source: UMBRAGE,
    blind_spot: "A mean: a bright crack in a large umbra hides; see p99 and the worst tile.",
};

pub(super) const FALSE_SHADOW: MetricInfo = MetricInfo {
    id: "false_shadow",
    name: "False shadow",
    unit: "visibility",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "Mean darkness where the truth is fully lit: acne, and penumbrae that reach too far.",
    formula: "mean of 1 - v over the lit region (g at least 511/512, more than a pixel away from any penumbra); of g - v where truth is each frame's own",
    source: UMBRAGE,
    blind_spot: "A mean: a patch of acne in a large lit floor hides; see p99 and the worst tile.",
};

pub(super) const LIGHT_LEAK_P99: MetricInfo = MetricInfo {
    id: "light_leak_p99",
    name: "Light leak, 99th percentile",
    unit: "visibility",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "One umbra point in a hundred is lighter than this.",
    formula: "99th percentile over umbra points of the mean of v over frames and seeds",
    source: UMBRAGE,
    blind_spot: "A leak smaller than a hundredth of the umbra.",
};

pub(super) const FALSE_SHADOW_P99: MetricInfo = MetricInfo {
    id: "false_shadow_p99",
    name: "False shadow, 99th percentile",
    unit: "visibility",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "One lit point in a hundred is darker than this.",
    formula: "99th percentile over lit points of the mean of 1 - v over frames and seeds",
    source: UMBRAGE,
    blind_spot: "A patch smaller than a hundredth of the lit region.",
};

pub(super) const P95: MetricInfo = MetricInfo {
    id: "p95",
    name: "Error, 95th percentile",
    unit: "visibility",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "One penumbra point in twenty is wrong by more than this.",
    formula: "95th percentile over points of sqrt(mean_ts (v - r1)(v - r2)), negative means as 0",
    source: UMBRAGE,
    blind_spot: "Reference noise is in it point by point; it matters when the error is as small.",
};

pub(super) const P99: MetricInfo = MetricInfo {
    id: "p99",
    name: "Error, 99th percentile",
    unit: "visibility",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "One penumbra point in a hundred is wrong by more than this.",
    formula: "99th percentile over points of sqrt(mean_ts (v - r1)(v - r2)), negative means as 0",
    source: UMBRAGE,
    blind_spot: "Reference noise is in it point by point; it matters when the error is as small.",
};

pub(super) const WORST_TILE: MetricInfo = MetricInfo {
    id: "worst_tile",
    name: "Worst tile",
    unit: "visibility",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "The largest ERROR of any tile with enough penumbra: a hot spot hides in a mean.",
    formula: "max over tiles with at least 32 penumbra points of sqrt(the tile's MSE)",
    source: UMBRAGE,
    blind_spot: "A maximum grows with the number of tiles: compare it on equal views only. It has no interval.",
};

pub(super) const OUTSIDE_SHARE: MetricInfo = MetricInfo {
    id: "outside_share",
    name: "Error outside the penumbra",
    unit: "share",
    range: SHARE,
    direction: Descriptive,
    definition: "How much of the whole squared error lies outside the true penumbra, where the cells do not look.",
    formula: "squared error in umbra and light / squared error everywhere",
    source: UMBRAGE,
    blind_spot: "A share: it rises when the penumbra gets better.",
};

pub(super) const EDGE_CRAWL: MetricInfo = MetricInfo {
    id: "edge_crawl",
    name: "Edge crawl",
    unit: "visibility squared",
    range: "-1 to 1",
    direction: Descriptive,
    definition: "What a reading at pixels, instead of at anchored points, adds to SWIMMING: edges that step from pixel to pixel.",
    formula: "SWIMMING of the pixel reading - SWIMMING of the anchored reading, paired",
    source: UMBRAGE,
    blind_spot: "Belongs to the picture's resolution, not to the technique.",
};

pub(super) const REFERENCE_NOISE: MetricInfo = MetricInfo {
    id: "reference_noise",
    name: "Noise of the truth",
    unit: "visibility squared",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "Variance of the truth itself. The scores do not contain it; it says how fine a map can be read.",
    formula: "mean over the penumbra of (r1 - r2)^2 / 4",
    source: UMBRAGE,
    blind_spot: "A bias that both halves share.",
};

pub(super) const COVERAGE: MetricInfo = MetricInfo {
    id: "coverage",
    name: "Coverage",
    unit: "share",
    range: SHARE,
    direction: TargetOne,
    definition: "Share of the surface points facing the light that were scored.",
    formula: "anchors that are the same surface in every frame / anchors that face the light",
    source: UMBRAGE,
    blind_spot: "Points that leave the picture along the path are lost here too: a fast path covers less.",
};

pub(super) const DISAGREEMENT: MetricInfo = MetricInfo {
    id: "disagreement",
    name: "Disagreement",
    unit: "share",
    range: SHARE,
    direction: LowerIsBetter,
    definition: "How often truth and raster see different surfaces in a pixel: silhouettes, or a wrong matrix.",
    formula: "anchors inside the picture on another surface / anchors inside the picture, over all frames",
    source: UMBRAGE,
    blind_spot: "Two surfaces in one plane look the same.",
};

pub(super) const BASIS_SHARE: MetricInfo = MetricInfo {
    id: "basis_share",
    name: "Smooth share of white error",
    unit: "share",
    range: SHARE,
    direction: Descriptive,
    definition: "Share of a structureless error that the smooth row takes, because the projection has that many functions.",
    formula: "functions of the projection / penumbra points",
    source: UMBRAGE,
    blind_spot: "Errors that are not white leak differently.",
};
