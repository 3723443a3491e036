//! The scorecard: everything that a run found, and everything needed to run it again.

mod check;
mod measured;
mod provenance;
mod results;
mod subjects;

pub(crate) use measured::ScoreSchema;

pub use measured::{Direction, Measured, MetricCard};
pub use provenance::{AdapterCard, Provenance, SceneCard, TruthCard};
pub use results::{Cost, OverallCard, PairedCard, PassCost, ResultCard};
pub use subjects::{Calibration, SettingsCard, VariantCard, WindowCard};

use crate::error::{ReportError, write_whole};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The version of `scorecard.json` that this crate writes, and the only one that it reads.
pub const SCHEMA_VERSION: u32 = 1;

/// What a run found: (window, variant, metric) to score, with full provenance. `scorecard.json`.
///
/// Windows and variants are referred to by their place in `windows` and `variants`, from 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scorecard {
    /// [`SCHEMA_VERSION`]. A file of another version is refused.
    pub schema_version: u32,
    /// What was run, on what, and how to run it again.
    pub provenance: Provenance,
    /// The definitions of the scores, in display order. Stored with the run, so that an old page
    /// keeps saying what was measured then.
    pub metrics: Vec<MetricCard>,
    /// The scored windows: T frames of a path through a scene.
    pub windows: Vec<WindowCard>,
    /// The variants, in display order.
    pub variants: Vec<VariantCard>,
    /// At most one per window and variant; a missing one reads "not measured".
    pub results: Vec<ResultCard>,
    /// At most one per variant: pooled over all windows.
    pub overall: Vec<OverallCard>,
    /// Paired differences between variants.
    pub paired: Vec<PairedCard>,
}

impl Scorecard {
    /// Reads `scorecard.json` and checks it.
    ///
    /// # Errors
    /// A file that is missing, no scorecard, of another [`SCHEMA_VERSION`], or that contradicts
    /// itself.
    pub fn load(path: &Path) -> Result<Self, ReportError> {
        let text = std::fs::read_to_string(path).map_err(ReportError::at(path))?;
        let refuse = |reason: String| ReportError::Scorecard { path: path.into(), reason };
        // The version is looked at first: fields of another version mean other things.
        let any: serde_json::Value =
            serde_json::from_str(&text).map_err(|e| refuse(format!("not JSON: {e}")))?;
        match any.get("schema_version").and_then(serde_json::Value::as_u64) {
            Some(version) if version == u64::from(SCHEMA_VERSION) => {}
            Some(version) => {
                return Err(refuse(format!(
                    "schema_version {version}, but this program reads version {SCHEMA_VERSION}; \
                     run the evaluation again, or use the release that wrote the file"
                )));
            }
            None => return Err(refuse("no schema_version: not a scorecard".into())),
        }
        let card: Self = serde_json::from_str(&text).map_err(|e| refuse(format!("not a scorecard: {e}")))?;
        card.check()?;
        Ok(card)
    }

    /// Writes `scorecard.json`, after checking it.
    ///
    /// # Errors
    /// A number that is not finite, a card that points nowhere, or a file that cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), ReportError> {
        write_whole(path, self.to_json()?.as_bytes())
    }

    /// The text of `scorecard.json`.
    ///
    /// # Errors
    /// As [`Scorecard::check`].
    pub fn to_json(&self) -> Result<String, ReportError> {
        self.check()?;
        let text = serde_json::to_string_pretty(self);
        text.map(|t| t + "\n").map_err(|e| ReportError::Contradiction(e.to_string()))
    }

    /// The result of a variant in a window.
    pub(crate) fn result(&self, window: usize, variant: usize) -> Option<&ResultCard> {
        self.results.iter().find(|r| r.window == window && r.variant == variant)
    }

    /// The pooled result of a variant.
    pub(crate) fn overall_of(&self, variant: usize) -> Option<&OverallCard> {
        self.overall.iter().find(|o| o.variant == variant)
    }

    /// The definition of a metric.
    pub(crate) fn metric(&self, id: &str) -> Option<&MetricCard> {
        self.metrics.iter().find(|m| m.id == id)
    }

    /// The value that a perfect variant would have.
    pub(crate) fn goal(&self, id: &str) -> f64 {
        self.metric(id).map_or(0.0, |m| m.direction.goal())
    }
}

/// Of frames that skip no number.
pub(crate) const fn one() -> u32 {
    1
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the shape that serde asks for")]
pub(crate) const fn is_one(step: &u32) -> bool {
    *step == 1
}

/// The JSON schema of `scorecard.json`. A copy is shipped as `scorecard.schema.json`.
pub fn scorecard_schema() -> String {
    let schema = schemars::schema_for!(Scorecard);
    // A schema is plain JSON; the alternate form of its value cannot fail.
    format!("{:#}\n", schema.as_value())
}
