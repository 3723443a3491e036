//! ERROR and its five cells.

use super::Direction::LowerIsBetter;
use super::{MetricInfo, UMBRAGE};

const SQUARE: &str = "visibility squared";
const CELL: &str = "0 to 1; small negative values are legal (unbiased, not clamped)";
const PATH: &str = "Only T frames of one path at one speed: equal T, path and speed compare.";
const SPLIT: &str = "The smooth/structured split is a convention: fixed Vogel-16 bands leak about a third into the smooth row. Column sums do not depend on it.";

pub(super) const ERROR: MetricInfo = MetricInfo {
    id: "error",
    name: "ERROR (RMSE)",
    unit: "visibility",
    range: "0 to 1",
    direction: LowerIsBetter,
    definition: "Root of the mean squared error of the shadow in the penumbra: how far it is from the truth.",
    formula: "sqrt(MSE)",
    source: UMBRAGE,
    blind_spot: "Says nothing about the kind of error, nor about how visible it is.",
};

pub(super) const MSE: MetricInfo = MetricInfo {
    id: "mse",
    name: "MSE",
    unit: SQUARE,
    range: CELL,
    direction: LowerIsBetter,
    definition: "Mean squared error of the shadow in the penumbra; the five cells add up to it exactly.",
    formula: "mean over t, s of (v_ts - r1)(v_ts - r2), with two independent halves r1, r2 of the truth",
    source: UMBRAGE,
    blind_spot: "Says nothing about the kind of error, nor about how visible it is.",
};

pub(super) const BANDING: MetricInfo = MetricInfo {
    id: "banding",
    name: "BANDING",
    unit: SQUARE,
    range: CELL,
    direction: LowerIsBetter,
    definition: "The structured row: bands, aliasing and texel patterns, whether they stand still or crawl.",
    formula: "structured static + structured moving",
    source: UMBRAGE,
    blind_spot: SPLIT,
};

pub(super) const SWIMMING: MetricInfo = MetricInfo {
    id: "swimming",
    name: "SWIMMING",
    unit: SQUARE,
    range: CELL,
    direction: LowerIsBetter,
    definition: "The moving column: how much the shadow at fixed surface points changes while only the camera moves. The truth does not change there at all.",
    formula: "M = (1/T) sum_t (v_t - v)^2 - N (T-1)/(T S)",
    source: UMBRAGE,
    blind_spot: PATH,
};

pub(super) const NOISE: MetricInfo = MetricInfo {
    id: "noise",
    name: "NOISE",
    unit: SQUARE,
    range: "0 to 1",
    direction: LowerIsBetter,
    definition: "What differs between pattern seeds: the grain of a stochastic shadow.",
    formula: "N = sum_ts (v_ts - v_t)^2 / (T (S-1)); 0 for a variant without randomness",
    source: UMBRAGE,
    blind_spot: "White, blue and red noise of one variance score the same: see the noise after a blur.",
};

pub(super) const SMOOTH_STATIC: MetricInfo = MetricInfo {
    id: "smooth_static",
    name: "Smooth, static",
    unit: SQUARE,
    range: CELL,
    direction: LowerIsBetter,
    definition: "Smooth bias that stands still: a penumbra of the wrong width, over- or under-darkening.",
    formula: "B = (v - r1)(v - r2) - N/(T S), of the projected error P e",
    source: UMBRAGE,
    blind_spot: SPLIT,
};

pub(super) const SMOOTH_MOVING: MetricInfo = MetricInfo {
    id: "smooth_moving",
    name: "Smooth, moving",
    unit: SQUARE,
    range: CELL,
    direction: LowerIsBetter,
    definition: "Smooth swim: a penumbra that breathes while the camera moves.",
    formula: "M of the projected error P e",
    source: UMBRAGE,
    blind_spot: PATH,
};

pub(super) const STRUCTURED_STATIC: MetricInfo = MetricInfo {
    id: "structured_static",
    name: "Structured, static",
    unit: SQUARE,
    range: CELL,
    direction: LowerIsBetter,
    definition: "Bands and aliasing that stand still on the surface.",
    formula: "B of the rest (1 - P) e",
    source: UMBRAGE,
    blind_spot: SPLIT,
};

pub(super) const STRUCTURED_MOVING: MetricInfo = MetricInfo {
    id: "structured_moving",
    name: "Structured, moving",
    unit: SQUARE,
    range: CELL,
    direction: LowerIsBetter,
    definition: "Bands that crawl over the surface, texels that swim. Counted in BANDING and in SWIMMING, once in the MSE.",
    formula: "M of the rest (1 - P) e",
    source: UMBRAGE,
    blind_spot: PATH,
};
