//! A score, or the reason why there is none; and what a score means.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use umbrage_metrics::{Measurement, MetricInfo, Score};

/// A score, or why there is none. Never a zero that nobody measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Measured {
    /// Measured, with its 95 % interval.
    Score(#[schemars(with = "ScoreSchema")] Score),
    /// Not measured.
    NotMeasured {
        /// Why, as a reader should see it: "one frame only", "needs a GPU".
        not_measured: String,
    },
}

impl Measured {
    /// Not measured, and why: "one frame only". Pages say "not measured" themselves.
    pub fn no(reason: impl Into<String>) -> Self {
        let reason = reason.into();
        let reason = reason.strip_prefix("not measured: ").map_or(reason.clone(), str::to_string);
        Self::NotMeasured { not_measured: reason }
    }

    /// The score, where there is one.
    pub fn score(&self) -> Option<Score> {
        match self {
            Self::Score(score) => Some(*score),
            Self::NotMeasured { .. } => None,
        }
    }
}

impl From<Score> for Measured {
    fn from(score: Score) -> Self {
        Self::Score(score)
    }
}

impl From<Measurement> for Measured {
    fn from(measurement: Measurement) -> Self {
        match measurement {
            Measurement::Measured(score) => Self::Score(score),
            Measurement::NotMeasured(missing) => Self::no(missing.to_string()),
        }
    }
}

/// The shape of [`Score`] for the schema: `metrics` knows nothing of schemas.
#[derive(JsonSchema)]
#[schemars(rename = "Score")]
#[expect(dead_code, reason = "only its shape is used")]
pub(crate) struct ScoreSchema {
    /// The estimate.
    value: f64,
    /// Lower end of the 95 % interval.
    low: f64,
    /// Upper end of the 95 % interval.
    high: f64,
}

/// Which way a score points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Less is better; 0 is perfect.
    Lower,
    /// 1 is right; on either side it is wrong.
    One,
    /// Describes; neither end is better.
    Descriptive,
}

impl Direction {
    /// The value that a perfect variant would have; of what only describes, 0: its interval is read
    /// about that.
    pub(crate) fn goal(self) -> f64 {
        match self {
            Self::One => 1.0,
            Self::Lower | Self::Descriptive => 0.0,
        }
    }
}

/// What a score means: the definitions at the end of the page.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct MetricCard {
    /// The key in `scores`: `error`, `structured_moving`.
    pub id: String,
    /// As printed: ERROR, crawling bands.
    pub name: String,
    /// Unit; empty for a pure number.
    pub unit: String,
    /// Legal values.
    pub range: String,
    /// Which way it points.
    pub direction: Direction,
    /// One or two sentences.
    pub definition: String,
    /// How it is computed.
    pub formula: String,
    /// Paper or section it comes from.
    pub source: String,
    /// What it cannot see.
    pub blind_spot: String,
}

impl From<&MetricInfo> for MetricCard {
    fn from(info: &MetricInfo) -> Self {
        Self {
            id: info.id.into(),
            name: info.name.into(),
            unit: info.unit.into(),
            range: info.range.into(),
            direction: match info.direction {
                umbrage_metrics::Direction::LowerIsBetter => Direction::Lower,
                umbrage_metrics::Direction::TargetOne => Direction::One,
                umbrage_metrics::Direction::Descriptive => Direction::Descriptive,
            },
            definition: info.definition.into(),
            formula: info.formula.into(),
            source: info.source.into(),
            blind_spot: info.blind_spot.into(),
        }
    }
}
