//! A verdict on a change: a number before and after, at the same points, seeds and frames, against a
//! margin below which nobody cares (an equivalence test; METRICS section 5).
//!
//! The question is whether *these* pictures got worse, so tiles are not a sample of anything: all that varies
//! from run to run is the pattern seeds, and their spread is measured ([`seed_spread`](crate::seed_spread); decision 0013). The
//! statistic is the difference over its standard error, with Student's t; what may fail is corrected by Holm's
//! step-down method (Holm 1979). Blind spot: a change that leaves every gated number alone.

use crate::interval::CONFIDENCE;
use crate::{MetricsError, PooledNumber, Quantity, Score};
use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// The numbers that a gate looks at, in display order.
pub const GATED: [PooledNumber; 8] = [
    PooledNumber::Cell(Quantity::Error),
    PooledNumber::Cell(Quantity::Banding),
    PooledNumber::Cell(Quantity::Swimming),
    PooledNumber::Cell(Quantity::Noise),
    PooledNumber::BlockNoise,
    PooledNumber::Cell(Quantity::LightLeak),
    PooledNumber::Cell(Quantity::FalseShadow),
    PooledNumber::WidthRatio,
];

/// What is too small to matter: the larger of the two.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Margin {
    /// In the number's own unit.
    pub absolute: f64,
    /// Part of the baseline's value.
    pub relative: f64,
}

impl Margin {
    /// For a number whose baseline has this value.
    pub fn at(self, base: f64) -> f64 {
        self.absolute.max(self.relative * base.abs())
    }

    /// The margin of a number where nobody says otherwise. Visibility squared for banding, swimming and
    /// noise; visibility for ERROR, leak and false shadow.
    pub fn usual(number: PooledNumber) -> Self {
        let [absolute, relative] = match number {
            PooledNumber::Cell(Quantity::Error) => [2e-4, 0.01],
            PooledNumber::Cell(Quantity::Banding) => [2e-6, 0.02],
            PooledNumber::Cell(Quantity::Swimming) => [5e-6, 0.1],
            PooledNumber::Cell(Quantity::Noise) => [5e-6, 0.05],
            PooledNumber::BlockNoise => [5e-7, 0.05],
            PooledNumber::Cell(Quantity::LightLeak | Quantity::FalseShadow) => [2e-4, 0.02],
            _ => [0.01, 0.0],
        };
        Self { absolute, relative }
    }
}

/// A value with what varies from run to run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// The number.
    pub value: f64,
    /// Its variance over pattern seeds; 0 for a variant without randomness.
    pub variance: f64,
    /// Degrees of freedom of that variance; of no account where it is 0.
    pub freedom: f64,
}

/// A number of a variant, before and after.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// Which number.
    pub number: PooledNumber,
    /// The baseline's; none where it is not defined.
    pub base: Option<Reading>,
    /// What it is now.
    pub now: Option<Reading>,
    /// What is too small to matter.
    pub margin: Margin,
}

/// What became of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Better by more than the margin, corrected for the number of trials.
    Improved,
    /// The whole interval lies within the margin.
    Unchanged,
    /// Worse by more than the margin, corrected for the number of trials.
    Regressed,
    /// The interval reaches over the margin: more seeds would decide.
    Inconclusive,
}

/// What a trial came to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// The baseline's value.
    pub base: f64,
    /// The value now.
    pub now: f64,
    /// How much worse, with its own 95 % interval: now minus base; of a number that is right at 1, how much
    /// farther from it.
    pub harm: Score,
    /// The margin that was applied.
    pub margin: f64,
    /// The outcome.
    pub verdict: Verdict,
    /// The least harm that would have been caught 95 % of the time.
    pub caught: f64,
    /// The least margin at which this would not be a regression.
    pub would_pass_at: f64,
    /// How many times as many seeds (or points) would decide; 1 where it is decided, none where the harm is
    /// the margin itself.
    pub needs_times: Option<f64>,
}

/// Judges everything that can fail together. `None`: the number is not defined there, before and after.
///
/// # Errors
/// A number that is defined on one side only, or not finite.
pub fn judge(trials: &[Trial]) -> Result<Vec<Option<Change>>, MetricsError> {
    let found: Vec<Option<Found>> = trials.iter().map(found).collect::<Result<_, _>>()?;
    let count = found.iter().flatten().count();
    let worse: Vec<Option<f64>> = found.iter().map(|e| e.map(|e| e.beyond(1.0))).collect();
    let better: Vec<Option<f64>> = found.iter().map(|e| e.map(|e| e.beyond(-1.0))).collect();
    let (worse, better) = (holm(&worse), holm(&better));
    let change = |(i, found): (usize, &Option<Found>)| {
        let found = (*found)?;
        let Score { low, high, .. } = found.interval();
        let verdict = match () {
            () if worse[i] => Verdict::Regressed,
            () if better[i] => Verdict::Improved,
            () if low >= -found.margin && high <= found.margin => Verdict::Unchanged,
            () => Verdict::Inconclusive,
        };
        Some(found.change(verdict, count))
    };
    Ok(found.iter().enumerate().map(change).collect())
}

#[derive(Clone, Copy)]
struct Found {
    base: f64,
    now: f64,
    harm: f64,
    error: f64,
    freedom: f64,
    margin: f64,
}

fn found(trial: &Trial) -> Result<Option<Found>, MetricsError> {
    let (base, now) = match (trial.base, trial.now) {
        (None, None) => return Ok(None),
        (Some(base), Some(now)) => (base, now),
        _ => return Err(MetricsError::Unlike("a number is defined on one side only")),
    };
    if [base.value, base.variance, now.value, now.variance].iter().any(|v| !v.is_finite()) {
        return Err(MetricsError::Unlike("a number is not finite"));
    }
    let harm = trial.number.harm(base.value, now.value);
    // Welch and Satterthwaite: two spreads estimated on their own.
    let variance = base.variance + now.variance;
    let part = |r: Reading| if r.variance > 0.0 { r.variance.powi(2) / r.freedom.max(1.0) } else { 0.0 };
    let freedom = if variance > 0.0 { variance.powi(2) / (part(base) + part(now)) } else { 1.0 };
    Ok(Some(Found {
        base: base.value,
        now: now.value,
        harm,
        error: variance.sqrt(),
        freedom,
        margin: trial.margin.at(base.value),
    }))
}

impl PooledNumber {
    /// How much worse `now` is than `base`, in the number's own unit.
    pub fn harm(self, base: f64, now: f64) -> f64 {
        match self {
            // Right at 1: harm is to get farther from it.
            Self::WidthRatio => (now - 1.0).abs() - (base - 1.0).abs(),
            _ => now - base,
        }
    }
}

impl Found {
    fn student(&self) -> Option<StudentsT> {
        StudentsT::new(0.0, 1.0, self.freedom.max(1.0)).ok()
    }

    /// So many standard errors that a chance of `tail` is cut off.
    fn reach(&self, tail: f64) -> f64 {
        if self.error == 0.0 {
            return 0.0;
        }
        self.error * self.student().map_or(f64::INFINITY, |t| t.inverse_cdf(1.0 - tail))
    }

    fn interval(&self) -> Score {
        let half = self.reach(0.5 * (1.0 - CONFIDENCE));
        Score { value: self.harm, low: self.harm - half, high: self.harm + half }
    }

    /// Probability of a harm (or, with -1, a good) at least this far beyond the margin if it were the margin.
    fn beyond(&self, side: f64) -> f64 {
        let excess = side * self.harm - self.margin;
        match excess > 0.0 {
            false => 1.0,
            // Nothing varies: the difference is what it is.
            true if self.error == 0.0 => 0.0,
            true => self.student().map_or(1.0, |t| t.sf(excess / self.error)),
        }
    }

    fn change(&self, verdict: Verdict, count: usize) -> Change {
        // With all the others' correction against it.
        let strict = self.reach((1.0 - CONFIDENCE) / count.max(1) as f64);
        let apart = (self.harm.abs() - self.margin).abs();
        let half = if self.harm > self.margin { strict } else { self.reach(0.5 * (1.0 - CONFIDENCE)) };
        Change {
            base: self.base,
            now: self.now,
            harm: self.interval(),
            margin: self.margin,
            verdict,
            caught: self.margin + strict + self.reach(1.0 - CONFIDENCE),
            // Whatever its rank among the others: the last is judged without correction.
            would_pass_at: (self.harm - self.reach(1.0 - CONFIDENCE)).max(0.0),
            needs_times: match verdict {
                Verdict::Inconclusive => Some((half / apart).powi(2).max(1.0)).filter(|t| t.is_finite()),
                _ => Some(1.0),
            },
        }
    }
}

/// Which of the probabilities are below chance after Holm's step-down correction.
fn holm(all: &[Option<f64>]) -> Vec<bool> {
    let mut order: Vec<(f64, usize)> = all.iter().enumerate().filter_map(|(i, p)| Some(((*p)?, i))).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = order.len();
    let mut passes = vec![false; all.len()];
    for (rank, &(p, index)) in order.iter().enumerate() {
        if p > (1.0 - CONFIDENCE) / (count - rank) as f64 {
            break;
        }
        passes[index] = true;
    }
    passes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Rng;

    const NOISE: PooledNumber = PooledNumber::Cell(Quantity::Noise);
    const MARGIN: Margin = Margin { absolute: 1e-3, relative: 0.0 };

    fn reading(value: f64, error: f64) -> Option<Reading> {
        Some(Reading { value, variance: error * error, freedom: 40.0 })
    }

    fn trial(base: Option<Reading>, now: Option<Reading>) -> Trial {
        Trial { number: NOISE, base, now, margin: MARGIN }
    }

    fn verdicts(trials: &[Trial]) -> Vec<Option<Verdict>> {
        judge(trials).expect("judged").into_iter().map(|c| c.map(|c| c.verdict)).collect()
    }

    #[test]
    fn what_does_not_vary_is_what_it_is() {
        use Verdict::*;
        let steps = [0.0, 0.9e-3, 1.1e-3, -0.9e-3, -1.1e-3];
        let trials = steps.map(|step| trial(reading(0.01, 0.0), reading(0.01 + step, 0.0)));
        assert_eq!(verdicts(&trials), [Unchanged, Unchanged, Regressed, Unchanged, Improved].map(Some));
        let same = judge(&trials[..1]).expect("judged")[0].expect("defined");
        assert_eq!((same.harm.low, same.harm.high, same.would_pass_at, same.caught), (0.0, 0.0, 0.0, 1e-3));
    }

    #[test]
    fn all_four_verdicts() {
        use Verdict::*;
        let pairs = [(6e-3, 1e-4), (-6e-3, 1e-4), (1.2e-3, 1e-3), (0.0, 1e-4)];
        let trials = pairs.map(|(step, error)| trial(reading(0.01, error), reading(0.01 + step, error)));
        assert_eq!(verdicts(&trials), [Regressed, Improved, Inconclusive, Unchanged].map(Some));
        let unsure = judge(&trials[2..3]).expect("judged")[0].expect("defined");
        // One-sided t of 80 degrees of freedom at 5 %: 1.66; standard error 1.41e-3, 2e-4 from the margin.
        let times = unsure.needs_times.expect("finite");
        assert!((times - (1.664 * 1.4142e-3 / 2e-4f64).powi(2)).abs() < 1.0, "{times}");
    }

    #[test]
    fn a_width_is_right_at_one() {
        let width = |base, now| Trial {
            number: PooledNumber::WidthRatio,
            base: reading(base, 0.0),
            now: reading(now, 0.0),
            margin: Margin::usual(PooledNumber::WidthRatio),
        };
        use Verdict::*;
        let trials = [width(1.1, 1.05), width(0.95, 0.9), width(1.1, 0.9), width(1.0, 1.02)];
        assert_eq!(verdicts(&trials), [Improved, Regressed, Unchanged, Regressed].map(Some));
    }

    /// One that would fail alone is uncertain among many.
    #[test]
    fn many_trials_are_corrected_for() {
        let shift = trial(reading(0.01, 2e-4), reading(0.01 + 1e-3 + 6e-4, 2e-4));
        assert_eq!(verdicts(&[shift]), [Some(Verdict::Regressed)]);
        let mut many = vec![trial(reading(0.01, 2e-4), reading(0.01, 2e-4)); 2000];
        many.push(shift);
        assert_eq!(verdicts(&many).pop().flatten(), Some(Verdict::Inconclusive));
    }

    /// A harm of the margin itself fails in one of twenty at most, and what is said to be caught 95 % of the
    /// time is: 950 of 1000 are expected, with a standard deviation of 7, or 2 of a known spread more.
    #[test]
    fn error_rates_are_what_is_said() {
        let mut rng = Rng::new(7, 0);
        let mut normal =
            move || (0..12).map(|_| rng.below(1 << 20) as f64 / f64::from(1u32 << 20)).sum::<f64>() - 6.0;
        let error = 3e-4;
        let mut failures = |shift: f64| {
            let mut draw = |value: f64| reading(value + error * normal(), error);
            let trials = (0..1000).map(|_| trial(draw(0.01), draw(0.01 + shift)));
            trials.filter(|t| verdicts(&[*t])[0] == Some(Verdict::Regressed)).count()
        };
        let at_margin = failures(1e-3);
        assert!((28..=72).contains(&at_margin), "{at_margin} of 1000 at the margin");
        let caught = judge(&[trial(reading(0.01, error), reading(0.01, error))]).expect("judged")[0];
        let caught = failures(caught.expect("defined").caught);
        assert!((925..=975).contains(&caught), "{caught} of 1000");
        assert_eq!(failures(0.0), 0, "no change at all is well below the margin");
    }

    #[test]
    fn one_side_alone_is_refused_and_neither_is_nothing() {
        assert!(judge(&[trial(reading(0.0, 0.0), None)]).is_err());
        assert!(judge(&[trial(reading(f64::NAN, 0.0), reading(0.0, 0.0))]).is_err());
        assert_eq!(verdicts(&[trial(None, None)]), [None]);
    }
}
