//! A scorecard is checked before it is written and after it is read.

use super::{Measured, OverallCard, ResultCard, Scorecard};
use crate::ReportError;
use std::collections::{BTreeMap, BTreeSet};
use umbrage_metrics::Score;

impl Scorecard {
    /// Every number is finite, every reference leads somewhere, nothing is said twice.
    ///
    /// # Errors
    /// The first offence, named by scene, path, variant and metric.
    pub fn check(&self) -> Result<(), ReportError> {
        self.check_windows()?;
        let mut seen = BTreeSet::new();
        for result in &self.results {
            let place = self.place(Some(result.window), result.variant)?;
            if !seen.insert((result.window, result.variant)) {
                return Err(ReportError::Contradiction(format!("{place}: two results")));
            }
            result.check(&place)?;
        }
        let mut seen = BTreeSet::new();
        for overall in &self.overall {
            let place = self.place(None, overall.variant)?;
            if !seen.insert(overall.variant) {
                return Err(ReportError::Contradiction(format!("{place}: two results")));
            }
            overall.check(&place)?;
        }
        self.check_pairs()
    }

    fn check_windows(&self) -> Result<(), ReportError> {
        for window in &self.windows {
            let place = format!("{}, {}", window.scene, window.path);
            finite(window.coverage, &place, "coverage")?;
            finite(window.picture, &place, "picture")?;
            finite(window.occluded, &place, "occluded")?;
            finite(window.disagreement, &place, "disagreement")?;
            finite(window.reference_noise, &place, "reference_noise")?;
            finite(window.truth_secs.unwrap_or(0.0), &place, "truth_secs")?;
        }
        Ok(())
    }

    fn check_pairs(&self) -> Result<(), ReportError> {
        for pair in &self.paired {
            let a = self.place(pair.window, pair.a)?;
            let place = format!("{a} minus {}", self.place(pair.window, pair.b)?);
            finite_score(pair.difference, &place, &pair.metric)?;
        }
        Ok(())
    }

    /// "scene, path, variant (calibration)", for messages.
    fn place(&self, window: Option<usize>, variant: usize) -> Result<String, ReportError> {
        let lost = |what, index| ReportError::Contradiction(format!("there is no {what} {index}"));
        let card = self.variants.get(variant).ok_or_else(|| lost("variant", variant))?;
        let name = format!("{} ({})", card.name, card.calibration.label());
        let Some(window) = window else { return Ok(format!("all scenes, {name}")) };
        let window = self.windows.get(window).ok_or_else(|| lost("window", window))?;
        Ok(format!("{}, {}, {name}", window.scene, window.path))
    }
}

impl ResultCard {
    fn check(&self, place: &str) -> Result<(), ReportError> {
        finite_scores(&self.scores, place)?;
        self.noise_spectrum.iter().try_for_each(|&v| finite(v, place, "noise_spectrum"))?;
        self.per_frame_swimming.iter().try_for_each(|&s| finite_score(s, place, "per_frame_swimming"))
    }
}

impl OverallCard {
    fn check(&self, place: &str) -> Result<(), ReportError> {
        finite_scores(&self.scores, place)?;
        let Some(cost) = &self.cost else { return Ok(()) };
        finite(cost.frame_ms_median, place, "cost, median")?;
        finite(cost.frame_ms_p95, place, "cost, p95")?;
        finite(cost.once_per_scene_ms.unwrap_or(0.0), place, "cost, once a scene")?;
        cost.passes.iter().try_for_each(|p| finite(p.median_ms, place, &p.name))
    }
}

fn finite_scores(scores: &BTreeMap<String, Measured>, place: &str) -> Result<(), ReportError> {
    let measured = scores.iter().filter_map(|(id, m)| Some((id, m.score()?)));
    measured.into_iter().try_for_each(|(id, score)| finite_score(score, place, id))
}

fn finite_score(score: Score, place: &str, metric: &str) -> Result<(), ReportError> {
    [score.value, score.low, score.high].into_iter().try_for_each(|v| finite(v, place, metric))
}

fn finite(value: f64, place: &str, metric: &str) -> Result<(), ReportError> {
    let problem = || ReportError::NotFinite { place: place.into(), metric: metric.into() };
    value.is_finite().then_some(()).ok_or_else(problem)
}
