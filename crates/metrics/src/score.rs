//! What every measurement returns.

use serde::{Deserialize, Serialize};
use std::fmt;

/// A measured value with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// The estimate.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
}

impl Score {
    /// A value that is known exactly (a count, a share of pixels).
    pub fn exact(value: f64) -> Self {
        Self { value, low: value, high: value }
    }

    /// Whether a number lies in the interval, ends included.
    pub fn contains(&self, number: f64) -> bool {
        self.low <= number && number <= self.high
    }
}

/// A score, or the reason why there is none. A cell that was not measured is never 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measurement {
    /// There is a number.
    Measured(Score),
    /// There is none.
    NotMeasured(Missing),
}

impl Measurement {
    /// The score, where there is one.
    pub fn score(&self) -> Option<Score> {
        match *self {
            Self::Measured(score) => Some(score),
            Self::NotMeasured(_) => None,
        }
    }

    /// The estimate, where there is one.
    pub fn value(&self) -> Option<f64> {
        self.score().map(|s| s.value)
    }
}

/// Why a legal picture gives no number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Missing {
    /// What moves cannot be seen in one frame.
    OneFrame,
    /// Noise is what differs between seeds, and there is one.
    OneSeed,
    /// The truth has no penumbra in this view.
    NoPenumbra,
    /// The truth has no umbra in this view.
    NoUmbra,
    /// The truth has no fully lit surface in this view.
    NoLit,
    /// The variant has no noise to describe.
    NoNoise,
    /// There is no error at all, hence no share of it.
    NoError,
    /// SWIMMING is not resolved above 0, so its rhythm means nothing.
    NothingSwims,
    /// Edges of one direction only: no spread over directions.
    OneEdgeAngle,
    /// Penumbrae too small for a profile, or no rise across them.
    NoProfile,
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OneFrame => "not measured: one frame only",
            Self::OneSeed => "not measured: one seed only",
            Self::NoPenumbra => "not measured: no penumbra in this view",
            Self::NoUmbra => "not measured: no umbra in this view",
            Self::NoLit => "not measured: no fully lit surface in this view",
            Self::NoNoise => "not measured: this variant has no noise",
            Self::NoError => "not measured: there is no error",
            Self::NothingSwims => "not measured: no swimming is resolved above 0",
            Self::NoProfile => "not measured: no rise across any penumbra large enough for a profile",
            Self::OneEdgeAngle => "not measured: edges of one direction only",
        })
    }
}
