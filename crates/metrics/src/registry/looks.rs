//! Metrics of whole pictures, shown beside the scores and never mixed in.

use super::Direction::{LowerIsBetter, TargetOne};
use super::MetricInfo;

pub(super) const FLIP: MetricInfo = MetricInfo {
    id: "flip",
    name: "FLIP",
    unit: "",
    range: "0 to 1",
    direction: LowerIsBetter,
    definition: "How different the shaded picture looks from the shaded truth when one flips between them.",
    formula: "mean LDR-FLIP of the sRGB pictures at a stated exposure and number of pixels per degree",
    source: "Andersson et al., FLIP: A Difference Evaluator for Alternating Images, HPG 2020; flip-rs",
    blind_spot: "Sees one frame: it knows no time. Depends on the exposure and on the viewing distance.",
};

pub(super) const SSIM: MetricInfo = MetricInfo {
    id: "ssim",
    name: "SSIM",
    unit: "",
    range: "-1 to 1",
    direction: TargetOne,
    definition: "Structural similarity of the shadow mask to the truth, as papers report it.",
    formula: "mean of SSIM over 11x11 Gaussian windows, sigma 1.5, K1 0.01, K2 0.03, population covariance",
    source: "Wang et al., Image Quality Assessment, IEEE TIP 13(4), 2004",
    blind_spot: "Flat regions (most of a mask) score 1 and dilute it; noise in dark flat regions is overrated.",
};
