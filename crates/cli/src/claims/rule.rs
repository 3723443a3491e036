//! The rule of docs/claims.md: from intervals to verdicts.

use serde::Deserialize;
use umbrage_metrics::Score;
use umbrage_report::{Outcome, Verdict};

/// How A's number is expected to lie to B's.
#[derive(Deserialize, Clone, Copy, Debug, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Relation {
    Below,
    Above,
    Equal,
    NotBelow,
    NotAbove,
}

impl Relation {
    /// For people.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Below => "below",
            Self::Above => "above",
            Self::Equal => "equal",
            Self::NotBelow => "not below",
            Self::NotAbove => "not above",
        }
    }

    /// What an effect with its interval says, for a margin of at least 0. `None` when it is not a
    /// finite number: that is never a verdict.
    pub(crate) fn outcome(self, effect: Score, margin: f64) -> Option<Outcome> {
        if ![effect.value, effect.low, effect.high, margin].iter().all(|v| v.is_finite()) {
            return None;
        }
        let Score { low, high, .. } = effect;
        let (holds, fails) = match self {
            Self::Below => (high < -margin, low > -margin),
            Self::Above => (low > margin, high < margin),
            Self::Equal => (low >= -margin && high <= margin, low > margin || high < -margin),
            Self::NotBelow => (low > -margin, high < -margin),
            Self::NotAbove => (high < margin, low > margin),
        };
        Some(match (holds, fails) {
            (true, _) => Outcome::Holds,
            (_, true) => Outcome::Fails,
            _ => Outcome::Inconclusive,
        })
    }
}

/// The verdict on a claim from its parts; those that were not measured have no vote.
pub(crate) fn verdict(parts: &[Outcome]) -> Verdict {
    let count = |outcome| parts.iter().filter(|p| **p == outcome).count();
    let (holds, fails) = (count(Outcome::Holds), count(Outcome::Fails));
    let measured = holds + fails + count(Outcome::Inconclusive);
    match (measured, holds, fails) {
        (0, ..) if count(Outcome::NeedsGpu) > 0 => Verdict::NeedsGpu,
        (0, ..) => Verdict::NotMeasured,
        (all, holds, _) if holds == all => Verdict::Holds,
        (_, 0, 0) => Verdict::Inconclusive,
        (_, 0, _) => Verdict::Fails,
        _ => Verdict::HoldsPartly,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Outcome::{Fails, Holds, Inconclusive, NeedsGpu, NotMeasured};

    fn said(relation: Relation, low: f64, high: f64) -> Outcome {
        let effect = Score { value: 0.5 * (low + high), low, high };
        relation.outcome(effect, 0.1).expect("finite")
    }

    #[test]
    fn below_needs_the_whole_interval() {
        assert_eq!(said(Relation::Below, -0.3, -0.2), Holds);
        assert_eq!(said(Relation::Below, -0.3, -0.05), Inconclusive);
        assert_eq!(said(Relation::Below, -0.05, 0.05), Fails);
        assert_eq!(
            said(Relation::Below, -0.2, -0.1),
            Inconclusive,
            "an end on the margin is on neither side"
        );
    }

    #[test]
    fn above_mirrors_below() {
        assert_eq!(said(Relation::Above, 0.2, 0.3), Holds);
        assert_eq!(said(Relation::Above, 0.05, 0.3), Inconclusive);
        assert_eq!(said(Relation::Above, -0.05, 0.05), Fails);
    }

    #[test]
    fn equal_is_an_equivalence_test() {
        assert_eq!(said(Relation::Equal, -0.05, 0.05), Holds);
        assert_eq!(said(Relation::Equal, -0.05, 0.15), Inconclusive);
        assert_eq!(said(Relation::Equal, 0.15, 0.25), Fails);
        assert_eq!(said(Relation::Equal, -0.25, -0.15), Fails);
        assert_eq!(said(Relation::Equal, -0.2, 0.2), Inconclusive, "too wide to say anything");
        let same = Relation::Equal.outcome(Score::exact(0.0), 0.0);
        assert_eq!(same, Some(Holds), "identity is exact");
    }

    #[test]
    fn negations_hold_where_the_opposite_fails() {
        for (low, high) in [(-0.3, -0.2), (-0.2, 0.0), (-0.05, 0.05), (0.05, 0.2), (0.2, 0.3)] {
            let opposite = |outcome| match outcome {
                Holds => Fails,
                Fails => Holds,
                other => other,
            };
            assert_eq!(said(Relation::NotBelow, low, high), opposite(said(Relation::Below, low, high)));
            assert_eq!(said(Relation::NotAbove, low, high), opposite(said(Relation::Above, low, high)));
        }
    }

    #[test]
    fn nan_is_never_an_outcome() {
        for (value, low, high) in [(f64::NAN, 0.0, 1.0), (0.0, f64::NAN, 1.0), (0.0, 0.0, f64::INFINITY)] {
            for relation in [Relation::Below, Relation::Above, Relation::Equal] {
                assert_eq!(relation.outcome(Score { value, low, high }, 0.1), None);
            }
        }
        assert_eq!(Relation::Equal.outcome(Score::exact(0.0), f64::NAN), None);
    }

    #[test]
    fn a_verdict_needs_all_parts_some_or_none() {
        assert_eq!(verdict(&[Holds, Holds]), Verdict::Holds);
        assert_eq!(verdict(&[Holds, NeedsGpu]), Verdict::Holds);
        assert_eq!(verdict(&[Holds, Fails]), Verdict::HoldsPartly);
        assert_eq!(verdict(&[Holds, Inconclusive]), Verdict::HoldsPartly);
        assert_eq!(verdict(&[Fails, Inconclusive]), Verdict::Fails);
        assert_eq!(verdict(&[Inconclusive, Inconclusive]), Verdict::Inconclusive);
        assert_eq!(verdict(&[NeedsGpu, NotMeasured]), Verdict::NeedsGpu);
        assert_eq!(verdict(&[NotMeasured]), Verdict::NotMeasured);
        assert_eq!(verdict(&[]), Verdict::NotMeasured);
    }
}
