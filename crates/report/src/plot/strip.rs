//! A dot with its interval on a column's own axis.

use super::look::p;
use super::{Axis, Target};
use maud::{Markup, html};
use umbrage_metrics::Score;

const WIDTH: f64 = 84.0;
const MARGIN: f64 = 4.0;
const MIDDLE: f64 = 6.0;

/// The dot of a score. What lies off the low end of a logarithmic axis is a hollow dot at it.
pub(crate) fn strip(score: Score, axis: &Axis, target: Target) -> Markup {
    let place = |v: f64| MARGIN + axis.at(v) * (WIDTH - 2.0 * MARGIN);
    let (low, high, dot) = (place(score.low), place(score.high), place(score.value));
    let goal = match target {
        Target::One => Some(1.0),
        Target::Zero if axis.low < 0.0 => Some(0.0),
        Target::Zero => None,
    };
    let class = if axis.is_below(score.value) { "dot off" } else { "dot" };
    html! {
        svg.strip viewBox="0 0 84 12" width="84" height="12" aria-hidden="true" {
            line.rule x1=(p(MARGIN)) x2=(p(WIDTH - MARGIN)) y1=(p(MIDDLE)) y2=(p(MIDDLE)) {}
            @if let Some(goal) = goal {
                line.goal x1=(p(place(goal))) x2=(p(place(goal))) y1="1" y2="11" {}
            }
            @if high - low > 0.5 {
                line.interval x1=(p(low)) x2=(p(high)) y1=(p(MIDDLE)) y2=(p(MIDDLE)) {}
            }
            circle class=(class) cx=(p(dot)) cy=(p(MIDDLE)) r="3" {}
        }
    }
}
