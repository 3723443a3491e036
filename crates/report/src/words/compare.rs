//! Who is better than whom, as far as intervals carry it.

use crate::{Measured, Scorecard};
use std::collections::BTreeMap;
use umbrage_metrics::Score;

/// Below this a moving cell is 0 to rounding (METRICS: known answers).
const ROUNDING: f64 = 1e-30;

/// Comparisons in one window, or pooled over all.
#[derive(Clone, Copy)]
pub(crate) struct Comparison<'a> {
    pub(crate) card: &'a Scorecard,
    /// None: pooled over all windows.
    pub(crate) window: Option<usize>,
}

impl<'a> Comparison<'a> {
    /// The scores of a variant.
    pub(crate) fn scores(self, variant: usize) -> Option<&'a BTreeMap<String, Measured>> {
        match self.window {
            Some(window) => self.card.result(window, variant).map(|r| &r.scores),
            None => self.card.overall_of(variant).map(|o| &o.scores),
        }
    }

    /// A score, where it was measured.
    pub(crate) fn score(self, variant: usize, metric: &str) -> Option<Score> {
        self.scores(variant)?.get(metric)?.score()
    }

    /// The letters of a variant: those who share one cannot be told apart.
    pub(crate) fn group(self, variant: usize, metric: &str) -> Option<&'a str> {
        let groups = match self.window {
            Some(window) => &self.card.result(window, variant)?.groups,
            None => &self.card.overall_of(variant)?.groups,
        };
        groups.get(metric).map(String::as_str)
    }

    /// The variants that have this score, lowest first.
    pub(crate) fn ranked(self, metric: &str) -> Vec<(usize, Score)> {
        let all = 0..self.card.variants.len();
        let mut ranked: Vec<_> = all.filter_map(|v| Some((v, self.score(v, metric)?))).collect();
        ranked.sort_by(|a, b| a.1.value.total_cmp(&b.1.value));
        ranked
    }

    /// Whether `a` is lower than `b` beyond doubt: by the paired difference where there is one,
    /// otherwise (more cautiously) by intervals that do not meet.
    pub(crate) fn lower(self, a: usize, b: usize, metric: &str) -> bool {
        for pair in self.card.paired.iter().filter(|p| p.window == self.window && p.metric == metric) {
            if (pair.a, pair.b) == (a, b) {
                return pair.resolved && pair.difference.high < 0.0;
            }
            if (pair.a, pair.b) == (b, a) {
                return pair.resolved && pair.difference.low > 0.0;
            }
        }
        match (self.score(a, metric), self.score(b, metric)) {
            (Some(a), Some(b)) => a.high < b.low,
            _ => false,
        }
    }

    /// The reason why nobody has this score, as the first variant that gives one says it.
    pub(crate) fn reason(self, metric: &str) -> Option<&'a str> {
        (0..self.card.variants.len()).find_map(|v| match self.scores(v)?.get(metric)? {
            Measured::NotMeasured { not_measured } => Some(not_measured.as_str()),
            Measured::Score(_) => None,
        })
    }
}

/// Zero to rounding, with no interval to speak of.
pub(crate) fn is_still(score: Score) -> bool {
    [score.value, score.low, score.high].iter().all(|v| v.abs() < ROUNDING)
}

/// Cannot be told from zero.
pub(crate) fn is_unresolved(score: Score) -> bool {
    score.low <= 0.0
}
