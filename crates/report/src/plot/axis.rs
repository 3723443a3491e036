//! An axis: from numbers to places, with round ticks.

use crate::numbers::{Power, number};
use umbrage_metrics::Score;

/// Values that span more than this factor are shown on a logarithmic axis.
const LOG_FROM: f64 = 30.0;
/// A logarithmic axis never shows more than this many decades.
const MOST_DECADES: f64 = 6.0;

/// What a score should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// 0 is perfect.
    Zero,
    /// 1 is right.
    One,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Linear,
    Log,
    /// The root of the distance from 0, with its sign.
    Root,
}

/// An axis from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Axis {
    kind: Kind,
    pub(crate) low: f64,
    pub(crate) high: f64,
}

impl Axis {
    /// An axis on which all of these scores can be read.
    pub(crate) fn of(scores: &[Score], target: Target) -> Self {
        let lowest = scores.iter().map(|s| s.low.min(s.value)).fold(f64::INFINITY, f64::min);
        let highest = scores.iter().map(|s| s.high.max(s.value)).fold(f64::NEG_INFINITY, f64::max);
        if !(lowest.is_finite() && highest.is_finite()) {
            return Self { kind: Kind::Linear, low: 0.0, high: 1.0 };
        }
        match target {
            Target::One => Self::ends(lowest.min(0.9), highest.max(1.1), 20.0),
            Target::Zero => {
                // Only what is told apart from 0 has a place on a logarithmic axis.
                let resolved = scores.iter().filter(|s| s.low > 0.0).map(|s| s.value);
                let smallest = resolved.fold(f64::INFINITY, f64::min);
                if smallest.is_finite() && highest > LOG_FROM * smallest {
                    return Self::log(smallest, highest);
                }
                Self::ends(lowest.min(0.0), highest, 20.0)
            }
        }
    }

    /// A linear axis that ends at ticks.
    pub(crate) fn round(low: f64, high: f64) -> Self {
        Self::ends(low, high, 4.0)
    }

    /// A linear axis whose ends are round to about one of `parts`.
    fn ends(low: f64, high: f64, parts: f64) -> Self {
        let step = step(high - low, parts);
        let (low, mut high) = ((low / step + 1e-9).floor() * step, (high / step - 1e-9).ceil() * step);
        if high <= low {
            high = low + if step > 0.0 { step } else { 1.0 };
        }
        Self { kind: Kind::Linear, low, high }
    }

    /// A logarithmic axis of whole decades.
    pub(crate) fn log(smallest: f64, highest: f64) -> Self {
        let top = highest.log10().ceil();
        let bottom = smallest.log10().floor().max(top - MOST_DECADES).min(top - 1.0);
        Self { kind: Kind::Log, low: 10f64.powf(bottom), high: 10f64.powf(top) }
    }

    /// A logarithmic axis just around its values.
    pub(crate) fn log_close(smallest: f64, highest: f64) -> Self {
        Self { kind: Kind::Log, low: smallest / 1.5, high: highest * 1.5 }
    }

    /// An axis on which small and large values can both be seen, and those below 0 too.
    pub(crate) fn root(low: f64, high: f64) -> Self {
        let high = if high > 0.0 { high } else { 1.0 };
        // A little room below zero, so that lines at zero are not on the frame.
        Self { kind: Kind::Root, low: low.min(-0.002 * high), high }
    }

    /// Whether it is logarithmic.
    pub(crate) fn is_log(&self) -> bool {
        self.kind == Kind::Log
    }

    /// The place of a value, 0 to 1; what lies beyond is at the end.
    pub(crate) fn at(&self, value: f64) -> f64 {
        let curve = |v: f64| match self.kind {
            Kind::Linear => v,
            Kind::Log => v.max(self.low).ln(),
            Kind::Root => v.signum() * v.abs().sqrt(),
        };
        let (low, high) = (curve(self.low), curve(self.high));
        ((curve(value) - low) / (high - low)).clamp(0.0, 1.0)
    }

    /// Whether a value lies off its low end.
    pub(crate) fn is_below(&self, value: f64) -> bool {
        value < self.low * (1.0 - 1e-9)
    }

    /// Round values on the axis, lowest first.
    pub(crate) fn ticks(&self) -> Vec<f64> {
        match self.kind {
            Kind::Linear => {
                let step = step(self.high - self.low, 4.0);
                let first = (self.low / step - 1e-9).ceil() as i64;
                let last = (self.high / step + 1e-9).floor() as i64;
                (first..=last).map(|i| i as f64 * step).collect()
            }
            Kind::Log => self.log_ticks(),
            Kind::Root => {
                let top = step(self.high, 1.5);
                [0.0, 0.04, 0.2, 0.5, 1.0, 2.0].iter().map(|t| t * top).filter(|&t| t <= self.high).collect()
            }
        }
    }

    fn log_ticks(&self) -> Vec<f64> {
        let decades = (self.high / self.low).log10();
        let parts: &[f64] = if decades <= 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let (first, last) = (self.low.log10().floor() as i32, self.high.log10().ceil() as i32);
        let all = (first..=last).flat_map(|e| parts.iter().map(move |p| p * 10f64.powi(e)));
        all.filter(|t| (self.low * 0.999..=self.high * 1.001).contains(t)).collect()
    }

    /// A tick as printed under this power of ten.
    pub(crate) fn tick_label(power: Power, tick: f64) -> String {
        let text = number(power.scaled(tick));
        if !text.contains('.') {
            return text;
        }
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    }
}

/// A step of 1, 2 or 5 times a power of ten that divides `span` into about `parts`.
fn step(span: f64, parts: f64) -> f64 {
    if !(span.is_finite() && span > 0.0) {
        return 1.0;
    }
    let raw = span / parts;
    let decade = 10f64.powf(raw.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|m| m * decade);
    steps.into_iter().find(|s| *s >= raw * 0.999).unwrap_or(decade * 10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn score(value: f64, half: f64) -> Score {
        Score { value, low: value - half, high: value + half }
    }

    #[test]
    fn values_that_span_decades_get_a_logarithmic_axis() {
        let axis = Axis::of(&[score(1e-6, 1e-7), score(3e-3, 1e-5), score(0.0, 0.0)], Target::Zero);
        assert!(axis.is_log());
        assert!(axis.is_below(0.0), "a zero is drawn at the end, as one");
        assert_eq!((axis.at(1e-7), axis.at(1e-2)), (0.0, 1.0));
        assert!(!Axis::of(&[score(0.03, 0.001), score(0.05, 0.001)], Target::Zero).is_log());
    }

    #[test]
    fn an_unresolved_value_does_not_stretch_the_axis() {
        let axis = Axis::of(&[score(1e-12, 1e-6), score(3e-5, 1e-6)], Target::Zero);
        assert!(!axis.is_log());
        assert!(axis.low <= -1e-6);
    }

    #[test]
    fn a_ratio_always_shows_one() {
        let axis = Axis::of(&[score(0.91, 0.01)], Target::One);
        assert!(axis.low <= 0.9 && axis.high >= 1.0);
        assert!((0.0..=1.0).contains(&axis.at(1.0)));
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::round(0.0, 0.053);
        assert_eq!(axis.ticks().len(), 4, "0, 0.02, 0.04, 0.06: {:?}", axis.ticks());
        assert!(Axis::of(&[], Target::Zero).ticks().len() > 1, "an empty axis is still one");
        assert!(Axis::round(2.0, 2.0).ticks().len() > 1);
    }
}
