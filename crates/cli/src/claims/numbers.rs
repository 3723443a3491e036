//! The numbers of a comparison with their intervals, from pictures or from a GPU's clock.

use super::judge::Judge;
use super::needs::Measure;
use super::registry::{COSTS, Part, Take};
use super::subject::{Comparison, MemberAt, Resolved, ResolvedOther};
use crate::error::CliError;
use std::ops::Range;
use umbrage_metrics::{Member, MetricsError, PooledNumber, Score, compare_jointly, compare_medians};
use umbrage_report::EffectKind;

/// The numbers of a comparison.
#[derive(Clone, Copy)]
pub(super) struct Numbers {
    pub(super) ratio: Score,
    pub(super) difference: Score,
    pub(super) a: Score,
    pub(super) b: Score,
}

/// Why there is no number.
pub(super) enum Gap {
    NeedsGpu,
    Missing(String),
}

impl Judge<'_> {
    /// The numbers of a comparison, or why there are none.
    pub(super) fn numbers(
        &self,
        part: &Part,
        comparison: &Comparison,
    ) -> Result<Result<Numbers, Gap>, CliError> {
        let layout = Layout::of(comparison, part.target.unwrap_or(1.0));
        let members: Vec<MemberAt> = comparison.subjects().into_iter().flat_map(Resolved::readings).collect();
        let scores = if COSTS.contains(&part.number.as_str()) {
            self.cost_scores(part, &members, &layout)
        } else {
            self.pooled_scores(part, &members, &layout)?
        };
        Ok(scores.map(|s| Numbers { ratio: s[0], difference: s[1], a: s[2], b: s[3] }))
    }

    fn cost_scores(&self, part: &Part, members: &[MemberAt], layout: &Layout) -> Result<Vec<Score>, Gap> {
        if self.costs.origin().is_none() {
            return Err(Gap::NeedsGpu);
        }
        let mut samples = Vec::new();
        for member in members {
            let mut sample = Vec::new();
            for place in &member.places {
                let missing = || format!("the costs have no {} in {}", member.variant, place.label());
                let of_place = self.costs.sample(place, &member.variant, &part.number);
                sample.extend(of_place.ok_or_else(|| Gap::Missing(missing()))?);
            }
            samples.push(sample);
        }
        let samples: Vec<&[f64]> = samples.iter().map(Vec::as_slice).collect();
        compare_medians(&samples, |v| layout.effects(v), &self.bootstrap)
            .map_err(|e| Gap::Missing(e.to_string()))
    }

    fn pooled_scores(
        &self,
        part: &Part,
        members: &[MemberAt],
        layout: &Layout,
    ) -> Result<Result<Vec<Score>, Gap>, CliError> {
        let Some(number) = PooledNumber::named(&part.number) else {
            return Ok(Err(Gap::Missing(format!("there is no number {}", part.number))));
        };
        let measure = Measure::of(number, part);
        let mut grounds: Vec<(&str, &str)> = Vec::new();
        let mut pooled = Vec::new();
        for member in members {
            let mut windows = Vec::new();
            for place in &member.places {
                let Some(table) = self.measurements.table(place, &member.variant, (&measure, number.kind()))
                else {
                    let reason = self.measurements.reason(place, &member.variant);
                    return Ok(Err(Gap::Missing(reason)));
                };
                let known = grounds.iter().position(|g| *g == place.ground());
                let ground = known.unwrap_or_else(|| {
                    grounds.push(place.ground());
                    grounds.len() - 1
                });
                windows.push((ground, table));
            }
            pooled.push(Member { number, windows });
        }
        match compare_jointly(&pooled, |v| layout.effects(v), &self.bootstrap) {
            Ok(scores) => Ok(Ok(scores)),
            Err(error @ MetricsError::Zero(_)) => Ok(Err(Gap::Missing(error.to_string()))),
            Err(error) => Err(error.into()),
        }
    }
}

impl Numbers {
    pub(super) fn effect(&self, kind: EffectKind) -> Score {
        match kind {
            EffectKind::Ratio => self.ratio,
            EffectKind::Difference => self.difference,
        }
    }
}

/// Which values belong to which subject, in the order of [`Comparison::subjects`].
struct Layout {
    a: Reading,
    b: Result<Reading, f64>,
    from: Option<Reading>,
    per: Option<[Reading; 2]>,
    target: f64,
}

/// The values of a subject, and how they become one.
struct Reading {
    values: Range<usize>,
    take: Take,
    members: usize,
}

impl Layout {
    fn of(comparison: &Comparison, target: f64) -> Self {
        let mut next = 0;
        let mut read = |subject: &Resolved| {
            let start = next;
            next += subject.readings().len();
            Reading { values: start..next, take: subject.take, members: subject.members.len() }
        };
        let a = read(&comparison.a);
        let b = match &comparison.b {
            ResolvedOther::Constant(value) => Err(*value),
            ResolvedOther::Subject(b) => Ok(read(b)),
        };
        let from = comparison.from.as_ref().map(&mut read);
        let per = comparison.per.as_ref().map(|[a, b]| [read(a), read(b)]);
        Self { a, b, from, per, target }
    }

    /// A / B - 1, A - B, A and B.
    fn effects(&self, values: &[f64]) -> Vec<f64> {
        let mut a = self.a.number(values);
        let mut b = match &self.b {
            Ok(subject) => subject.number(values),
            Err(constant) => *constant,
        };
        if let Some(from) = &self.from {
            (a, b) = (a - from.number(values), b - from.number(values));
        }
        if let Some([per_a, per_b]) = &self.per {
            (a, b) = (a / per_a.number(values), b / per_b.number(values));
        }
        vec![a / (b * self.target) - 1.0, a - b, a, b]
    }
}

impl Reading {
    fn number(&self, values: &[f64]) -> f64 {
        let values = &values[self.values.clone()];
        match self.take {
            Take::Only | Take::Least => values.iter().copied().fold(f64::INFINITY, f64::min),
            Take::Spread => mean_spread(values, values.len() / self.members.max(1)),
        }
    }
}

/// Values lie member by member, each with its places: largest less smallest member in each place, mean
/// over places.
fn mean_spread(values: &[f64], places: usize) -> f64 {
    let spread = |place: usize| {
        let of_members = values.iter().skip(place).step_by(places);
        let (low, high) =
            of_members.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &v| (l.min(v), h.max(v)));
        high - low
    };
    (0..places).map(spread).sum::<f64>() / places as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_of_opposite_sign_in_two_places_do_not_cancel() {
        // Three members in two places: the first falls from 1.2 to 1.0, the second rises from .8 to 1.0.
        let spread = mean_spread(&[1.2, 0.8, 1.1, 0.9, 1.0, 1.0], 2);
        assert!((spread - 0.2).abs() < 1e-12, "{spread}");
        assert_eq!(mean_spread(&[3.0, 1.0, 2.0], 1), 2.0);
    }
}
