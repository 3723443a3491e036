//! What a gate found. `gate.json` in the folder of a run.

use crate::Provenance;
use crate::error::{ReportError, write_whole};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::Path;
use umbrage_metrics::{Change, Score, Verdict};

/// Every score that could fail, judged together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GateCard {
    /// What it was compared with.
    pub base: Side,
    /// What was compared.
    pub run: Side,
    /// Name of the baseline, as the user calls it.
    pub baseline: String,
    /// The command that makes the run the baseline.
    pub accept: String,
    /// Variants and windows that the baseline does not know.
    pub new: Vec<String>,
    /// Margins that were others when the baseline was made; the run's count.
    #[serde(default)]
    pub margins_changed: Vec<String>,
    /// One a scene, path, variant and score; and one a variant and score over all windows.
    pub cases: Vec<GateCase>,
}

/// One of the two runs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Side {
    /// Version of the program.
    pub tool_version: String,
    /// When it was run.
    pub date: String,
    /// Its command.
    pub command: String,
}

impl From<&Provenance> for Side {
    fn from(p: &Provenance) -> Self {
        Self { tool_version: p.tool_version.clone(), date: p.date.clone(), command: p.command.clone() }
    }
}

/// A score of a variant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GateCase {
    /// None: over all windows.
    pub scene: Option<String>,
    /// Name of the camera path.
    pub path: Option<String>,
    /// First frame of the window.
    pub first_frame: Option<u32>,
    /// `chss-mask/light-matched`.
    pub variant: String,
    /// Id of the score.
    pub metric: String,
    /// Of swimming: the frame that adds most to the motion that the baseline had not.
    pub worst_frame: Option<u32>,
    /// Left, top, width and height in pixels of the middle frame: where the score got worst.
    pub worst_place: Option<[u32; 4]>,
    /// What became of it; none where the score is not defined (no umbra in view).
    pub change: Option<ChangeCard>,
    /// The command that measures just this.
    pub reproduce: Option<String>,
    /// A picture of the worst place, in the folder of the run.
    pub crop: Option<String>,
    /// What it shows, left to right; without "before" where the baseline holds no pictures.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub crop_shows: Vec<String>,
}

/// See [`Change`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ChangeCard {
    /// The baseline's value.
    pub base: f64,
    /// The value now.
    pub now: f64,
    /// How much worse, with its 95 % interval.
    #[schemars(with = "crate::card::ScoreSchema")]
    pub harm: Score,
    /// What is too small to matter.
    pub margin: f64,
    /// The outcome.
    #[schemars(with = "String")]
    pub verdict: Verdict,
    /// The least harm that is caught 95 % of the time.
    pub caught: f64,
    /// The least margin at which it would pass.
    pub would_pass_at: f64,
    /// How many times as many seeds would decide.
    pub needs_times: Option<f64>,
}

impl From<Change> for ChangeCard {
    fn from(c: Change) -> Self {
        let Change { base, now, harm, margin, verdict, caught, would_pass_at, needs_times } = c;
        Self { base, now, harm, margin, verdict, caught, would_pass_at, needs_times }
    }
}

impl GateCard {
    /// The cases of a verdict.
    pub fn with(&self, verdict: Verdict) -> impl Iterator<Item = (&GateCase, &ChangeCard)> {
        let changed = self.cases.iter().filter_map(|c| Some((c, c.change.as_ref()?)));
        changed.filter(move |(_, change)| change.verdict == verdict)
    }

    /// "2 regressed, 1 improved, 100 unchanged, 4 inconclusive".
    pub fn counts(&self) -> String {
        use Verdict::{Improved, Inconclusive, Regressed, Unchanged};
        let words = [
            (Regressed, "regressed"),
            (Improved, "improved"),
            (Inconclusive, "inconclusive"),
            (Unchanged, "unchanged"),
        ];
        let part = |(verdict, word): (Verdict, &str)| format!("{} {word}", self.with(verdict).count());
        words.map(part).join(", ")
    }

    /// Reads `gate.json` of a run, if it was gated.
    ///
    /// # Errors
    /// A file that cannot be read or is something else.
    pub fn load(run: &Path) -> Result<Option<Self>, ReportError> {
        let path = run.join(GATE);
        if !path.exists() {
            return Ok(None);
        }
        let text = std::fs::read_to_string(&path).map_err(ReportError::at(&path))?;
        let card = serde_json::from_str(&text);
        card.map(Some).map_err(|e| ReportError::File { path, reason: format!("not a gate: {e}") })
    }

    /// Writes `gate.json` into a run.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, run: &Path) -> Result<(), ReportError> {
        let text =
            serde_json::to_string_pretty(self).map_err(|e| ReportError::Contradiction(e.to_string()))?;
        write_whole(&run.join(GATE), format!("{text}\n").as_bytes())
    }
}

pub(crate) const GATE: &str = "gate.json";

/// Before commands that are to be copied.
pub(crate) const MEASURE: &str = "measure just this: ";
pub(crate) const ACCEPT: &str = "accept it: ";

impl GateCase {
    /// "colonnade, P1" or "all windows".
    pub fn place(&self) -> String {
        match (&self.scene, &self.path) {
            (Some(scene), Some(path)) => format!("{scene}, {path}"),
            _ => "all windows".into(),
        }
    }

    /// Where to look and what to do, line by line.
    pub fn details(&self, gate: &GateCard) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some([left, top, width, height]) = self.worst_place {
            lines.push(format!("worst at pixels {left},{top}, in a block of {width}x{height} (2x2 tiles)"));
        }
        lines.extend(self.worst_frame.map(|f| format!("worst frame {f}")));
        lines.extend(self.crop.as_ref().map(|c| format!("picture {c}")));
        lines.extend(self.reproduce.as_ref().map(|r| format!("{MEASURE}{r}")));
        lines.push(format!("{ACCEPT}{}", gate.accept));
        lines
    }

    /// What happened, in a line.
    pub fn sentence(&self) -> String {
        let Some(c) = &self.change else { return "not defined here".into() };
        let head = format!(
            "{} went from {} to {}: {} worse ({} to {}), margin {}",
            self.metric.replace('_', " "),
            short(c.base),
            short(c.now),
            short(c.harm.value),
            short(c.harm.low),
            short(c.harm.high),
            short(c.margin)
        );
        match c.verdict {
            Verdict::Regressed => format!("{head}; would pass at {}", short_up(c.would_pass_at)),
            Verdict::Inconclusive => {
                let wanted = c.needs_times.map_or_else(
                    || "the harm is the margin itself".into(),
                    |t| format!("{t:.1} times as many seeds would decide"),
                );
                format!("{head}; {wanted}")
            }
            _ => head,
        }
    }
}

/// Three significant digits, never less than the value itself: what is to pass must pass when it is copied.
pub(crate) fn short_up(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let unit = 10f64.powi(value.abs().log10().floor() as i32 - 2);
    short((value / unit).ceil() * unit)
}

/// Three significant digits.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let decade = value.abs().log10().floor() as i32;
    if (-4..4).contains(&decade) {
        format!("{value:.*}", (2 - decade).max(0) as usize)
    } else {
        format!("{value:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A threshold that is copied from the page must not fail by its last digit.
    #[test]
    fn thresholds_are_rounded_up() {
        let pairs = [(0.012341, "0.0124"), (1.0, "1.00"), (0.0, "0"), (2.345e-6, "2.35e-6"), (99.91, "100")];
        for (value, text) in pairs {
            assert_eq!(short_up(value), text);
            assert!(short_up(value).parse::<f64>().expect("a number") >= value);
        }
        assert_eq!(short(0.012341), "0.0123");
    }
}
