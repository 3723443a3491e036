//! What explains a score.

use super::Direction::{Descriptive, LowerIsBetter, TargetOne};
use super::{MetricInfo, UMBRAGE};

const LAG1: &str = "lag-1 correlation of v_ts - v_t over frames, pooled over points and seeds";
const LAG1_RANGE: &str = "-1 to 1";
const LAG1_BLIND: &str = "One frame's distance only; a pattern that repeats every few frames looks random.";

pub(super) const WIDTH_RATIO: MetricInfo = MetricInfo {
    id: "width_ratio",
    name: "Penumbra width ratio",
    unit: "",
    range: "0 upwards; 0 is a hard edge",
    direction: TargetOne,
    definition: "Measured 10-90 % width of the penumbra over the true one.",
    formula: "area of 0.1 < v < 0.9 / area of 0.1 < g < 0.9, in tiles with or next to penumbra (v: mean over seeds and frames)",
    source: "Umbrage, after the coarea formula: area = width x edge length, and the edge is the same",
    blind_spot: "Grey leaks beside a penumbra count as width; a darkened umbra above 0.1 too. Weighs wide penumbrae most.",
};

pub(super) const WIDTH_ANISOTROPY: MetricInfo = MetricInfo {
    id: "width_anisotropy",
    name: "Width anisotropy",
    unit: "",
    range: "0 upwards",
    direction: LowerIsBetter,
    definition: "How much the width ratio depends on the direction of the shadow's edge on its receiver.",
    formula: "largest - smallest width ratio over 8 classes of edge direction of 22.5 degrees",
    source: UMBRAGE,
    blind_spot: "A range is biased upwards by noise; directions and blocker distances of a scene may be confounded.",
};

pub(super) const EFFECTIVE_LEVELS: MetricInfo = MetricInfo {
    id: "effective_levels",
    name: "Effective levels",
    unit: "levels",
    range: "1 (a hard edge) to the profile's resolution",
    direction: Descriptive,
    definition: "Into how many equal steps the seed-mean profile across the penumbra falls; a staircase of K levels has about K.",
    formula: "exp(H2) of the profile's increments d: sum d / sum(d_i^2 + 2 d_i d_(i+1)), squares as products of seed halves",
    source: "Umbrage; Renyi entropy of order 2",
    blind_spot: "Cannot count more levels than the truth itself shows in the same bins; a too narrow penumbra has fewer.",
};

pub(super) const PLATEAU_FRACTION: MetricInfo = MetricInfo {
    id: "plateau_fraction",
    name: "Plateau fraction",
    unit: "share",
    range: "0 to 1; small negative values are legal",
    direction: LowerIsBetter,
    definition: "Share of the profile across the penumbra on which the shadow stays flat although the truth rises: near 1 for a staircase, 0 for the truth.",
    formula: "1 - R(v)/R(g), R = (mean increment)^2 / (mean squared increment), squares as products of seed halves",
    source: UMBRAGE,
    blind_spot: "A too narrow penumbra is flat at both ends, and counts as plateau.",
};

pub(super) const VON_NEUMANN: MetricInfo = MetricInfo {
    id: "von_neumann",
    name: "Von Neumann ratio",
    unit: "",
    range: "0 to 2",
    direction: Descriptive,
    definition: "The rhythm of the swimming: near 0 a slow drift, 1 white, 2 a flicker from frame to frame.",
    formula: "MSSD / (2 M), MSSD = mean of (v_(t+1) - v_t)^2 less its noise",
    source: "von Neumann, Annals of Mathematical Statistics 12 (1941)",
    blind_spot: "One number for all rhythms; not measured where SWIMMING is not resolved above 0.",
};

pub(super) const LAG1_PIXEL_FROZEN: MetricInfo = MetricInfo {
    id: "lag1_pixel_frozen",
    name: "Noise correlation, fixed pixel, frozen pattern",
    unit: "",
    range: LAG1_RANGE,
    direction: Descriptive,
    definition: "Near 1: the grain sticks to the screen while the world moves behind it (\"shower door\").",
    formula: LAG1,
    source: UMBRAGE,
    blind_spot: LAG1_BLIND,
};

pub(super) const LAG1_POINT_FROZEN: MetricInfo = MetricInfo {
    id: "lag1_point_frozen",
    name: "Noise correlation, fixed point, frozen pattern",
    unit: "",
    range: LAG1_RANGE,
    direction: Descriptive,
    definition: "Near 1: the grain sticks to the world and reads as texture; near 0: it boils or slides.",
    formula: LAG1,
    source: UMBRAGE,
    blind_spot: LAG1_BLIND,
};

pub(super) const LAG1_PIXEL_ANIMATED: MetricInfo = MetricInfo {
    id: "lag1_pixel_animated",
    name: "Noise correlation, fixed pixel, animated pattern",
    unit: "",
    range: LAG1_RANGE,
    direction: Descriptive,
    definition: "Near 0: the grain boils; below 0: successive frames cancel, which a temporal filter likes.",
    formula: LAG1,
    source: UMBRAGE,
    blind_spot: LAG1_BLIND,
};

pub(super) const LAG1_POINT_ANIMATED: MetricInfo = MetricInfo {
    id: "lag1_point_animated",
    name: "Noise correlation, fixed point, animated pattern",
    unit: "",
    range: LAG1_RANGE,
    direction: Descriptive,
    definition: "As at a fixed pixel, at points of the surface.",
    formula: LAG1,
    source: UMBRAGE,
    blind_spot: LAG1_BLIND,
};

pub(super) const NOISE_AFTER_BLUR: MetricInfo = MetricInfo {
    id: "noise_after_blur",
    name: "Noise left after a visual blur",
    unit: "share",
    range: "0 to 1; white noise leaves 0.020",
    direction: LowerIsBetter,
    definition: "Share of the noise variance that a Gaussian blur of 2 px, about what an eye does, leaves: below white noise it is blue, above it is blotchy.",
    formula: "sum over lags of C(d) (k * k)(d) / C(0), C = autocovariance of v_ts - v_t in the middle frame",
    source: "Umbrage; the blur follows Georgiev and Fajardo, Blue-noise Dithered Sampling (2016)",
    blind_spot: "One blur for all viewing distances; lags beyond 8 px are not seen.",
};
