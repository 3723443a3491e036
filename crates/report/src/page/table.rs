//! The table: one row a variant, each number a dot with its interval on its column's own axis.

use super::columns::{Column, GROUPS, columns};
use crate::numbers::{Power, free_number, number, with_interval};
use crate::plot::{Axis, Look, Target, strip, swatch};
use crate::words::{Comparison, plain_line, swim_caveat};
use crate::{Calibration, Measured, Scorecard, VariantCard};
use maud::{Markup, html};
use umbrage_metrics::Score;

/// The pooled table with its explanation and its controls.
pub(super) fn section(card: &Scorecard) -> Markup {
    html! {
        section #table {
            h2 { "The variants, over all scenes" }
            p.lede {
                "Each dot is an estimate with its 95 % interval, on its column's own axis (logarithmic where values span "
                "decades). Less is better everywhere but for the width, where 1 is right. Rows that share a letter in a "
                "column cannot be told apart there (width and FLIP have no paired test, and no letters)."
            }
            div.controls hidden {
                label { "Filter " input.filter type="search" placeholder="name, document, words" size="24"; }
                label { input.printed type="checkbox" checked; " as printed" }
                label {
                    "Relative to "
                    select.relative {
                        option value="" { "nothing (absolute)" }
                        @for (v, variant) in card.variants.iter().enumerate() {
                            option value=(v) { (variant.name) ", " (variant.calibration.label()) }
                        }
                    }
                }
                span.muted.ratio-note hidden { "Ratios of the estimates; a ratio here has no interval." }
            }
            (scores(Comparison { card, window: None }))
        }
    }
}

/// What every row of a column shares.
struct Shared {
    /// Whether anybody has this score.
    measured: bool,
    column: &'static Column,
    power: Power,
    axis: Axis,
}

/// The scores of all variants, pooled or in one window.
pub(super) fn scores(scope: Comparison) -> Markup {
    let shared: Vec<Shared> = columns().map(|column| share(scope, column)).collect();
    let costs = scope.window.is_none();
    let width = shared.len() + 1 + usize::from(costs);
    html! {
        div.wide {
            table.scores {
                colgroup { col.name; @for _ in 1..width { col; } }
                thead {
                    tr.groups {
                        td {}
                        @for group in &GROUPS { th colspan=(group.columns.len()) scope="colgroup" { (group.head) } }
                        @if costs { th scope="colgroup" { "Cost" } }
                    }
                    tr {
                        th scope="col" { "variant" }
                        @for s in &shared { (header(s)) }
                        @if costs { th.sortable scope="col" { span.name { "GPU" } small { "ms a frame, bar to p95" } } }
                    }
                }
                // Light-matched is the comparison, as printed the curiosity: it comes second.
                @for calibration in [Calibration::Elsewhere, Calibration::LightMatched, Calibration::AsPrinted] {
                    @let rows = rows(scope.card, calibration);
                    @if !rows.is_empty() {
                        tbody.kind data-calibration=(calibration.label()) {
                            tr { th colspan=(width) scope="rowgroup" { (kind(calibration)) } }
                        }
                        @for v in rows { (row(scope, v, &shared)) }
                    }
                }
            }
        }
    }
}

fn rows(card: &Scorecard, calibration: Calibration) -> Vec<usize> {
    (0..card.variants.len()).filter(|&v| card.variants[v].calibration == calibration).collect()
}

fn kind(calibration: Calibration) -> &'static str {
    match calibration {
        Calibration::Elsewhere => "From elsewhere: frames of another program",
        Calibration::LightMatched => "Light-matched: kernels derived from the light of the scene",
        Calibration::AsPrinted => "As printed: the constants of the document",
    }
}

fn share(scope: Comparison, column: &'static Column) -> Shared {
    let all: Vec<Score> = (0..scope.card.variants.len()).filter_map(|v| scope.score(v, column.id)).collect();
    let axis = Axis::of(&all, column.target);
    Shared { measured: !all.is_empty(), column, power: Power::of(all.iter().map(|s| s.value)), axis }
}

fn header(shared: &Shared) -> Markup {
    let Shared { column, power, axis, measured } = shared;
    let unit = power.label();
    html! {
        th.sortable scope="col" {
            a.name href={ "#metric-" (column.id) } { (column.head) }
            small { (column.sub) @if !unit.is_empty() { ", " span.unit { (unit) } } }
            @if *measured {
                small.ends {
                    span { (Axis::tick_label(*power, axis.low)) }
                    @if axis.is_log() { span { "log" } }
                    span { (Axis::tick_label(*power, axis.high)) }
                }
            }
        }
    }
}

/// Two lines of the table: the numbers, and what they say.
fn row(scope: Comparison, v: usize, shared: &[Shared]) -> Markup {
    let variant = &scope.card.variants[v];
    let id = scope.window.is_none().then(|| format!("variant-{v}"));
    let costs = scope.window.is_none();
    let words = [&variant.name, variant.calibration.label(), &variant.source, &variant.sentence].join(" ");
    html! {
        tbody.variant id=[id] data-variant=(v) data-words=(words) data-calibration=(variant.calibration.label()) {
            tr {
                th.variant scope="row" {
                    div { (swatch(Look::of(scope.card, v))) strong { (variant.name) } }
                    small { (taps(variant)) }
                }
                @for s in shared { (cell(scope, v, s)) }
                @if costs { (cost(scope.card, v)) }
            }
            tr.line {
                td colspan=(shared.len() + 1 + usize::from(costs)) {
                    span { (scope.scores(v).map_or_else(|| "not measured".into(), plain_line)) @if let Some(caveat) = swim_caveat(scope.card, v) { ". " (caveat) } }
                }
            }
        }
    }
}

fn taps(variant: &VariantCard) -> String {
    let (taps, passes) = (&variant.taps, variant.passes);
    if variant.calibration == Calibration::Elsewhere {
        return taps.clone();
    }
    let (one_tap, one_pass) = (if taps == "1" { "" } else { "s" }, if passes == 1 { "" } else { "es" });
    let shape = format!("{taps} tap{one_tap} · {passes} pass{one_pass}");
    if variant.technique == variant.name { shape } else { format!("{} · {shape}", variant.technique) }
}

fn cell(scope: Comparison, v: usize, shared: &Shared) -> Markup {
    let column = shared.column;
    match scope.scores(v).and_then(|s| s.get(column.id)) {
        Some(Measured::Score(score)) => {
            let (value, interval) = shown(*score, scope.card.goal(column.id), shared.power);
            let exact = format!("{} to {}", free_number(score.low), free_number(score.high));
            html! {
                td data-metric=(column.id) data-value=(score.value) title={ (column.head) " " (free_number(score.value)) ", 95 %: " (exact) } {
                    span.value { (value) }
                    @if let Some(letters) = scope.group(v, column.id) { sup { (letters) } }
                    // A line of its own: side by side, values of neighbouring columns would meet.
                    @if let Some(interval) = interval { span.half { (interval) } }
                    (strip(*score, &shared.axis, column.target))
                }
            }
        }
        Some(Measured::NotMeasured { not_measured }) => html! { td.none { "not measured: " (not_measured) } },
        None => html! { td.none { "not measured" } },
    }
}

/// A number far below its column's power of ten would be a row of zeros.
fn shown(score: Score, goal: f64, power: Power) -> (String, Option<String>) {
    let size = power.scaled(score.value.abs().max(crate::numbers::half_width(score)));
    if size > 0.0 && size < 0.001 && score.value.abs() > 1e-30 {
        return (if score.value < 0.0 { "−0.001 to 0" } else { "< 0.001" }.into(), None);
    }
    with_interval(score, goal, power)
}

fn cost(card: &Scorecard, v: usize) -> Markup {
    let overall = card.overall_of(v);
    let Some(cost) = overall.and_then(|o| o.cost.as_ref()) else {
        let note = overall.and_then(|o| o.cost_note.as_deref()).unwrap_or("needs a GPU");
        return html! { td.none { (note) } };
    };
    let all = || card.overall.iter().filter_map(|o| o.cost.as_ref());
    let ends =
        |c: &crate::Cost| Score { value: c.frame_ms_median, low: c.frame_ms_median, high: c.frame_ms_p95 };
    let axis = Axis::of(&all().map(ends).collect::<Vec<_>>(), Target::Zero);
    let passes: Vec<String> =
        cost.passes.iter().map(|p| format!("{} {} ms", p.name, number(p.median_ms))).collect();
    let once =
        cost.once_per_scene_ms.map(|ms| format!("; once a scene {} ms", number(ms))).unwrap_or_default();
    html! {
        td data-metric="cost" data-value=(cost.frame_ms_median) title={ "p95 " (number(cost.frame_ms_p95)) " ms; " (passes.join(", ")) (once) } {
            span.value { (number(cost.frame_ms_median)) }
            (strip(ends(cost), &axis, Target::Zero))
        }
    }
}
