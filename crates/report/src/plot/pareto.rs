//! Error against cost: who is worth their price.

use super::axis::Axis;
use super::look::{Look, p};
use crate::Scorecard;
use crate::numbers::{Power, number};
use crate::words::{Comparison, full_name};
use maud::{Markup, html};
use umbrage_metrics::Score;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 62.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 28.0;
const BOTTOM: f64 = 48.0;

struct Point {
    variant: usize,
    median_ms: f64,
    p95_ms: f64,
    error: Score,
    swimming: f64,
}

/// The plot, or nothing when no variant has both a cost and an error.
pub(crate) fn pareto(card: &Scorecard) -> Option<Markup> {
    let points = points(card);
    if points.is_empty() {
        return None;
    }
    let fold =
        |f: fn(f64, f64) -> f64, start, value: fn(&Point) -> f64| points.iter().map(value).fold(start, f);
    let x = Axis::log_close(
        fold(f64::min, f64::INFINITY, |q| q.median_ms),
        fold(f64::max, 0.0, |q| q.p95_ms.max(q.median_ms)),
    );
    let y = Axis::round(0.0, fold(f64::max, 0.0, |q| q.error.high));
    let at_x = |v: f64| LEFT + x.at(v) * (WIDTH - LEFT - RIGHT);
    let at_y = |v: f64| HEIGHT - BOTTOM - y.at(v) * (HEIGHT - TOP - BOTTOM);
    let most_swim = fold(f64::max, 0.0, |q| q.swimming);
    // The area of a dot grows with its swimming: radius 4 (none) to 10 px (the most).
    let radius =
        |q: &Point| 4.0 + 6.0 * if most_swim > 0.0 { (q.swimming.max(0.0) / most_swim).sqrt() } else { 0.0 };
    let places: Vec<(f64, f64, f64)> =
        points.iter().map(|q| (at_x(q.median_ms), at_y(q.error.value), radius(q))).collect();
    let labels = labels(card, &points, &places, |q| at_x(q.p95_ms));
    let power = Power::of(std::iter::once(y.high));
    Some(html! {
        svg.plot viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="img" aria-label="Error against cost" {
            @for tick in y.ticks() {
                line.grid x1=(p(LEFT)) x2=(p(WIDTH - RIGHT)) y1=(p(at_y(tick))) y2=(p(at_y(tick))) {}
                text.tick x=(p(LEFT - 8.0)) y=(p(at_y(tick) + 4.0)) text-anchor="end" { (Axis::tick_label(power, tick)) }
            }
            @for tick in x.ticks() {
                line.grid x1=(p(at_x(tick))) x2=(p(at_x(tick))) y1=(p(TOP)) y2=(p(HEIGHT - BOTTOM)) {}
                text.tick x=(p(at_x(tick))) y=(p(HEIGHT - BOTTOM + 18.0)) text-anchor="middle" {
                    (Axis::tick_label(Power::ONE, tick))
                }
            }
            text.axis x=(p(WIDTH - RIGHT)) y=(p(HEIGHT - 8.0)) text-anchor="end" { "GPU time, ms a frame (median; bar to p95)" }
            text.axis x="0" y="10" { "ERROR, RMSE" @if power != Power::ONE { ", " (power.label()) } }
            path.frontier d=(frontier(&points, at_x, at_y)) {}
            @for (q, place) in points.iter().zip(&places) {
                @let class = format!("whisker {}", Look::of(card, q.variant).class());
                line class=(class) x1=(p(place.0)) x2=(p(place.0)) y1=(p(at_y(q.error.low))) y2=(p(at_y(q.error.high))) {}
                line class=(class) x1=(p(place.0)) x2=(p(at_x(q.p95_ms))) y1=(p(place.1)) y2=(p(place.1)) {}
            }
            @for (q, place) in points.iter().zip(&places) {
                g {
                    title { (full_name(&card.variants[q.variant])) ": " (number(q.median_ms)) " ms" }
                    (Look::of(card, q.variant).marker(place.0, place.1, place.2))
                }
            }
            @for label in &labels {
                @if (label.y - label.dot.1).abs() > 20.0 {
                    line.grid x1=(p(label.dot.0)) y1=(p(label.dot.1)) x2=(p(label.x)) y2=(p(label.y)) {}
                }
                text.label x=(p(label.x)) y=(p(label.y + 4.0)) text-anchor=(label.anchor) { (label.text) }
            }
        }
    })
}

fn points(card: &Scorecard) -> Vec<Point> {
    let all = Comparison { card, window: None };
    let point = |variant: usize| {
        let cost = card.overall_of(variant)?.cost.as_ref()?;
        let error = all.score(variant, "error")?;
        let swimming = all.score(variant, "swimming").map_or(0.0, |s| s.value);
        let usable = cost.frame_ms_median > 0.0;
        usable.then_some(Point {
            variant,
            median_ms: cost.frame_ms_median,
            p95_ms: cost.frame_ms_p95,
            error,
            swimming,
        })
    };
    (0..card.variants.len()).filter_map(point).collect()
}

/// Steps along the points that nothing cheaper beats.
fn frontier(points: &[Point], at_x: impl Fn(f64) -> f64, at_y: impl Fn(f64) -> f64) -> String {
    let mut by_cost: Vec<&Point> = points.iter().collect();
    by_cost.sort_by(|a, b| a.median_ms.total_cmp(&b.median_ms));
    let (mut path, mut best) = (String::new(), f64::INFINITY);
    for q in by_cost {
        if q.error.value < best {
            let (x, y) = (p(at_x(q.median_ms)), p(at_y(q.error.value)));
            path += &if path.is_empty() { format!("M{x} {}V{y}", p(TOP)) } else { format!("H{x}V{y}") };
            best = q.error.value;
        }
    }
    format!("{path}H{}", p(WIDTH - RIGHT))
}

struct Label {
    x: f64,
    y: f64,
    anchor: &'static str,
    text: String,
    /// What it names.
    dot: (f64, f64),
}

/// Beside each dot, where it meets no other dot or label: right, left, above or below.
fn labels(
    card: &Scorecard,
    points: &[Point],
    places: &[(f64, f64, f64)],
    whisker: impl Fn(&Point) -> f64,
) -> Vec<Label> {
    // Boxes as (left, top, right, bottom), from an average width of a letter at this size.
    let boxed = |(q, &(x, y, r)): (&Point, &(f64, f64, f64))| [x - r, y - r, whisker(q).max(x + r), y + r];
    let mut taken: Vec<[f64; 4]> = points.iter().zip(places).map(boxed).collect();
    let mut labels = Vec::new();
    for (q, &(x, y, r)) in points.iter().zip(places) {
        let text = card.variants[q.variant].name.clone();
        let same = |l: &Label| l.text == text && (l.dot.0 - x).hypot(l.dot.1 - y) < 3.0;
        if labels.iter().any(same) {
            // Both calibrations of a hard shadow are one dot: one name is enough.
            continue;
        }
        let width = 6.6 * text.chars().count() as f64;
        let right = (whisker(q).max(x + r) + 5.0, y, "start");
        let mut candidates = vec![
            right,
            (x - r - 5.0, y, "end"),
            (x, y - r - 9.0, "middle"),
            (x, y + r + 10.0, "middle"),
            (x + r + 3.0, y - 11.0, "start"),
            (x + r + 3.0, y + 12.0, "start"),
        ];
        // Farther away, tied to its dot by a line.
        for step in 2..8 {
            let away = 13.0 * f64::from(step);
            candidates.extend([
                (x + 8.0, y - away, "start"),
                (x + 8.0, y + away, "start"),
                (x - 8.0, y - away, "end"),
            ]);
        }
        let frame = |&(x, y, anchor): &(f64, f64, &str)| {
            let left = match anchor {
                "start" => x,
                "end" => x - width,
                _ => x - 0.5 * width,
            };
            [left, y - 7.0, left + width, y + 7.0]
        };
        let free = |c: &&(f64, f64, &str)| {
            let f = frame(c);
            let inside = f[0] > LEFT && f[2] < WIDTH && f[1] > TOP - 10.0;
            inside && taken.iter().all(|t| f[2] < t[0] || t[2] < f[0] || f[3] < t[1] || t[3] < f[1])
        };
        let &(lx, ly, anchor) = candidates.iter().find(free).unwrap_or(&right);
        taken.push(frame(&(lx, ly, anchor)));
        labels.push(Label { x: lx, y: ly, anchor, text, dot: (x, y) });
    }
    labels
}
