//! SWIMMING frame by frame along a path.

use super::axis::Axis;
use super::look::{Look, p};
use super::swatch;
use crate::numbers::Power;
use crate::words::{Sentence, full_name, is_still};
use crate::{ResultCard, Scorecard};
use maud::{Markup, html};
use umbrage_metrics::Score;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 280.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 28.0;
const BOTTOM: f64 = 40.0;

/// A line for each variant that moves, the others by name; nothing when no series was measured.
pub(crate) fn per_frame(card: &Scorecard, window: usize) -> Option<Markup> {
    let measured: Vec<&ResultCard> =
        card.results.iter().filter(|r| r.window == window && r.per_frame_swimming.len() > 1).collect();
    let is_flat = |r: &&ResultCard| r.per_frame_swimming.iter().all(|&s| is_still(s));
    let (still, moving): (Vec<_>, Vec<_>) = measured.iter().copied().partition(is_flat);
    if measured.is_empty() {
        return None;
    }
    let still: Vec<usize> = still.iter().map(|r| r.variant).collect();
    Some(html! {
        @if !moving.is_empty() {
            (lines(card, window, &moving))
            ul.legend {
                @for r in &moving {
                    li { (swatch(Look::of(card, r.variant))) (full_name(&card.variants[r.variant])) }
                }
            }
        }
        @if !still.is_empty() {
            p.note {
                (Sentence::default().text("At 0 in every frame, not drawn: ").variants(card, &still, 20).text("."))
            }
        }
    })
}

fn lines(card: &Scorecard, window: usize, moving: &[&ResultCard]) -> Markup {
    let all = || moving.iter().flat_map(|r| &r.per_frame_swimming);
    let high = all().map(|s| s.value).fold(0.0, f64::max);
    let low = all().map(|s| s.value).fold(0.0, f64::min);
    let frames = moving.iter().map(|r| r.per_frame_swimming.len()).max().unwrap_or(2);
    let y = Axis::root(low, 1.08 * high);
    let at_x = |frame: usize| LEFT + frame as f64 / (frames - 1) as f64 * (WIDTH - LEFT - RIGHT);
    let at_y = |v: f64| HEIGHT - BOTTOM - y.at(v) * (HEIGHT - TOP - BOTTOM);
    let power = Power::of(std::iter::once(high));
    let (first, step) =
        card.windows.get(window).map_or((0, 1), |w| (w.first_frame as usize, w.step as usize));
    // At most about sixteen numbers under the axis.
    let every = frames.div_ceil(16);
    html! {
        // The script turns it into a scrubber: it has to know where the frames are.
        svg.plot viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="img" aria-label="SWIMMING per frame"
            data-window=(window) data-frames=(frames) data-width=(WIDTH) data-left=(LEFT) data-right=(RIGHT)
            data-top=(TOP) data-bottom=(HEIGHT - BOTTOM) {
            @for tick in y.ticks() {
                line.grid x1=(p(LEFT)) x2=(p(WIDTH - RIGHT)) y1=(p(at_y(tick))) y2=(p(at_y(tick))) {}
                text.tick x=(p(LEFT - 8.0)) y=(p(at_y(tick) + 4.0)) text-anchor="end" { (Axis::tick_label(power, tick)) }
            }
            @for frame in (0..frames).step_by(every) {
                text.tick x=(p(at_x(frame))) y=(p(HEIGHT - BOTTOM + 20.0)) text-anchor="middle" { (first + frame * step) }
            }
            text.axis x=(p(WIDTH - RIGHT)) y=(p(HEIGHT - 4.0)) text-anchor="end" { "frame" }
            text.axis x="0" y="10" {
                "contribution to SWIMMING"
                @if power != Power::ONE { ", " (power.label()) }
                " (root scale)"
            }
            // Bands of what cannot be told from 0 would only lie on top of each other.
            @for r in moving.iter().filter(|r| is_resolved(&r.per_frame_swimming)) {
                path class={ "band " (Look::of(card, r.variant).class()) } d=(band(&r.per_frame_swimming, at_x, at_y)) {}
            }
            @for r in moving {
                @let look = Look::of(card, r.variant);
                path class={ "line " (look.class()) } d=(line(&r.per_frame_swimming, at_x, at_y)) {}
                @for (frame, score) in r.per_frame_swimming.iter().enumerate().step_by(every) {
                    (look.marker(at_x(frame), at_y(score.value), 3.0))
                }
            }
        }
    }
}

/// Most of its frames can be told from 0.
fn is_resolved(series: &[Score]) -> bool {
    2 * series.iter().filter(|s| s.low > 0.0).count() > series.len()
}

fn line(series: &[Score], at_x: impl Fn(usize) -> f64, at_y: impl Fn(f64) -> f64) -> String {
    let point = |(i, s): (usize, &Score)| format!("{} {}", p(at_x(i)), p(at_y(s.value)));
    format!("M{}", series.iter().enumerate().map(point).collect::<Vec<_>>().join("L"))
}

/// The intervals as an area: along the upper ends and back along the lower ones.
fn band(series: &[Score], at_x: impl Fn(usize) -> f64, at_y: impl Fn(f64) -> f64) -> String {
    let upper = series.iter().enumerate().map(|(i, s)| (i, s.high));
    let lower = series.iter().enumerate().rev().map(|(i, s)| (i, s.low));
    let point = |(i, v): (usize, f64)| format!("{} {}", p(at_x(i)), p(at_y(v)));
    format!("M{}Z", upper.chain(lower).map(point).collect::<Vec<_>>().join("L"))
}
