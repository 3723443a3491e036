//! What was found.

use super::Measured;
use super::measured::ScoreSchema;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use umbrage_metrics::Score;

/// The scores of a variant in a window.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ResultCard {
    /// Index into `windows`.
    pub window: usize,
    /// Index into `variants`.
    pub variant: usize,
    /// By metric id.
    pub scores: BTreeMap<String, Measured>,
    /// Each frame's contribution to SWIMMING (visibility squared); empty when not measured.
    #[serde(default)]
    #[schemars(with = "Vec<ScoreSchema>")]
    pub per_frame_swimming: Vec<Score>,
    /// Power of the noise at 1/64, 3/64, ... 31/64 cycles per pixel, white = 1; empty without noise.
    #[serde(default)]
    pub noise_spectrum: Vec<f64>,
    /// By metric id: variants of this window that share a letter cannot be told apart.
    #[serde(default)]
    pub groups: BTreeMap<String, String>,
}

/// The scores of a variant, pooled over all windows, and what it costs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OverallCard {
    /// Index into `variants`.
    pub variant: usize,
    /// By metric id.
    pub scores: BTreeMap<String, Measured>,
    /// By metric id: variants that share a letter cannot be told apart.
    #[serde(default)]
    pub groups: BTreeMap<String, String>,
    /// What it costs on a real adapter.
    pub cost: Option<Cost>,
    /// Why there is no cost: "not a cost: software adapter".
    pub cost_note: Option<String>,
}

/// Time on the adapter, from timestamp queries.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cost {
    /// On which adapter: costs of different adapters never mix.
    pub adapter: String,
    /// Median over frames, milliseconds a frame.
    pub frame_ms_median: f64,
    /// 95th percentile over frames, milliseconds a frame.
    pub frame_ms_p95: f64,
    /// The passes of a frame, in order.
    pub passes: Vec<PassCost>,
    /// What a static light pays once a scene, in milliseconds.
    pub once_per_scene_ms: Option<f64>,
}

/// One pass of a frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PassCost {
    /// Its label.
    pub name: String,
    /// Median over frames, milliseconds.
    pub median_ms: f64,
}

/// A paired difference: same tiles, seeds and frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PairedCard {
    /// Index into `variants`.
    pub a: usize,
    /// Index into `variants`.
    pub b: usize,
    /// Index into `windows`; none when pooled over all windows.
    pub window: Option<usize>,
    /// Metric id.
    pub metric: String,
    /// a minus b, with its own 95 % interval, not corrected for the number of comparisons.
    #[schemars(with = "ScoreSchema")]
    pub difference: Score,
    /// Whether the two can be told apart after Holm's correction for the number of comparisons: the
    /// decision that the letters in `groups` show.
    pub resolved: bool,
}
