//! `claims.json`: every claim with its verdict and the numbers behind it.

use crate::AdapterCard;
use serde::{Deserialize, Serialize};
use umbrage_metrics::Score;

/// Everything on the claims page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimsCard {
    /// Of this file's layout.
    pub schema_version: u32,
    /// What was run, on what.
    pub provenance: ClaimsProvenance,
    /// In the order of the registry.
    pub claims: Vec<ClaimCard>,
    /// The first document's table of times beside ours.
    pub times: Vec<DocumentTime>,
}

/// What was run, on what, and how to run it again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimsProvenance {
    /// Version of the program.
    pub tool_version: String,
    /// When the run was started, as RFC 3339.
    pub date: String,
    /// The command line to copy.
    pub command: String,
    /// What rendered the variants.
    pub adapter: AdapterCard,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Frames per window.
    pub frames: u32,
    /// Pattern seeds per frame.
    pub seeds: u32,
    /// Samples a point in each half of the truth.
    pub samples_per_half: u32,
    /// Side of the shadow map where a part says nothing else.
    pub shadow_map_texels: u32,
    /// Where costs come from, where there are any.
    pub costs: Option<CostOrigin>,
    /// Anything else that a reader should know.
    pub notes: Vec<String>,
}

/// Where costs come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostOrigin {
    /// As the driver calls it.
    pub adapter: String,
    /// Driver and its version.
    pub driver: String,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Side of the shadow map.
    pub shadow_map_texels: u32,
    /// When they were measured.
    pub date: String,
    /// With which command.
    pub command: String,
}

/// What became of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every part that was measured holds.
    Holds,
    /// Some do.
    HoldsPartly,
    /// None holds, and at least one fails.
    Fails,
    /// Nothing was decided.
    Inconclusive,
    /// Costs on a software adapter.
    NeedsGpu,
    /// No part could be measured, for other reasons.
    NotMeasured,
}

/// What became of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The whole interval lies where it was expected.
    Holds,
    /// The whole interval lies elsewhere.
    Fails,
    /// The interval lies on both sides.
    Inconclusive,
    /// A cost on a software adapter.
    NeedsGpu,
    /// See the part's reason.
    NotMeasured,
}

/// How A is set against B.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EffectKind {
    /// A / B - 1.
    Ratio,
    /// A - B.
    Difference,
}

/// A claim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimCard {
    /// "C7".
    pub id: String,
    /// Which document says so.
    pub document: String,
    /// What it says.
    pub statement: String,
    /// What a reader should know about how it was measured.
    pub note: Option<String>,
    /// What became of it.
    pub verdict: Verdict,
    /// What it is made of.
    pub parts: Vec<ClaimPart>,
    /// File of its crop, relative to the page.
    pub crop: Option<String>,
    /// What the crop shows.
    pub crop_caption: Option<String>,
}

/// One comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClaimPart {
    /// In words.
    pub says: String,
    /// What is compared.
    pub number: String,
    /// The first subject.
    pub a: String,
    /// The second subject, or the constant.
    pub b: String,
    /// Where.
    pub places: Vec<String>,
    /// "below", "above", "equal", "not below", "not above".
    pub expect: String,
    /// Smallest effect that matters.
    pub margin: f64,
    /// Why it is not the number's own.
    pub margin_reason: Option<String>,
    /// How A is set against B.
    pub effect_kind: EffectKind,
    /// With its 95 % interval.
    pub effect: Option<Score>,
    /// The number of A.
    pub value_a: Option<Score>,
    /// The number of B.
    pub value_b: Option<Score>,
    /// What became of it.
    pub outcome: Outcome,
    /// Why it was not measured, or why the effect is a difference.
    pub reason: Option<String>,
    /// Pattern seeds per frame; 0 where there is no picture.
    pub seeds: u32,
    /// Frames of a window (of a cost: repeats); 0 where there is no picture.
    pub frames: u32,
    /// Tiles over all places.
    pub tiles: u32,
    /// The effect in each place alone, where there are several.
    pub per_place: Vec<PlaceEffect>,
}

/// The effect in one place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlaceEffect {
    /// Where.
    pub place: String,
    /// With its interval.
    pub effect: Score,
}

/// A row of the first document's table of times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DocumentTime {
    /// What was timed.
    pub what: String,
    /// The document's milliseconds, on its card.
    pub document_ms: f64,
    /// Over the document's plain filter.
    pub document_ratio: f64,
    /// Our variant, or passes of it.
    pub ours: String,
    /// Its time over our plain filter's; none without a GPU.
    pub ratio: Option<Score>,
}

impl Verdict {
    /// All, in the order in which they are counted.
    pub const ALL: [Self; 6] =
        [Self::Holds, Self::HoldsPartly, Self::Fails, Self::Inconclusive, Self::NeedsGpu, Self::NotMeasured];

    /// For people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Holds => "Holds",
            Self::HoldsPartly => "Holds partly",
            Self::Fails => "Fails",
            Self::Inconclusive => "Inconclusive",
            Self::NeedsGpu => "Needs a GPU",
            Self::NotMeasured => "Not measured",
        }
    }
}

impl Outcome {
    /// For people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::Inconclusive => "inconclusive",
            Self::NeedsGpu => "needs a GPU",
            Self::NotMeasured => "not measured",
        }
    }
}
