//! Each scene and path in pictures: the truth, and every variant with its error and its swimming.

use super::columns::has_column;
use super::table;
use crate::book::{Book, Shown, Slot};
use crate::numbers::{Power, count, free_score_about, number, percent};
use crate::plot::{Axis, Look, swatch};
use crate::words::{Comparison, error_caption, plain_line, shadow_caption, swim_caption, swim_caveat};
use crate::{Calibration, Measured, ResultCard, Scorecard};
use maud::{Markup, html};

pub(super) fn section(card: &Scorecard, book: &Book) -> Markup {
    html! {
        section #scenes {
            h2 { "Scenes" }
            p.lede {
                "Middle frame of each window. Shadow: black is the umbra, white is fully lit, grey in proportion. Signed "
                "error: variant minus truth, blue too dark, red too light, one range for the whole page (beyond its ends colours are clamped). Swim map: how much "
                "each surface point changes while the camera moves. "
                span.hatch {} " Hatched: not counted (no surface, facing away from the light, or not the same surface in every frame); "
                "in a variant's shadow, only where nothing is seen (the sky)."
            }
            label.exact { input type="checkbox" id="exact"; " Never shrink a picture: one screen pixel for each of its own" }
            @for index in 0..card.windows.len() { (window(card, book, index)) }
        }
    }
}

fn window(card: &Scorecard, book: &Book, index: usize) -> Markup {
    let w = &card.windows[index];
    let of = format!(" in {}, {}", w.scene, w.path);
    let is_printed = |v: &usize| card.variants[*v].calibration == Calibration::AsPrinted;
    let (printed, shown): (Vec<usize>, Vec<usize>) = (0..card.variants.len()).partition(is_printed);
    html! {
        article.window id={ "window-" (index) } {
            h3 { (w.scene) " · " (w.path) " " span.muted { (w.speed) } }
            (facts(card, index))
            @if w.anchors == 0 {
                p.empty { "No anchors agreed in this view: check the camera." }
            }
            @if book.has(index) {
                div.strip-row {
                    (figure(book.shown(index, Slot::Truth), ("Truth", &of), Some("shadow"), ("0", "1"), html! {
                        "What every variant is compared with. Contact edges are sharp, and widen with the distance to what casts them."
                    }))
                    @if let Some(beauty) = book.shown(index, Slot::Beauty) {
                        (figure(Some(beauty), ("The view", &of), None, ("", ""), html! { "Where this is: the scene, shaded with the true shadow." }))
                    }
                }
                @for v in shown { (variant(card, book, index, v)) }
                @if !printed.is_empty() {
                    details {
                        summary { "As printed: " (printed.len()) " more, with the constants of their documents" }
                        @for &v in &printed { (variant(card, book, index, v)) }
                    }
                }
            } @else {
                p.empty { "No pictures were stored for this window." }
            }
            details {
                summary { "Every score in this window" }
                (table::scores(Comparison { card, window: Some(index) }))
                (further(card, index))
            }
        }
    }
}

fn facts(card: &Scorecard, index: usize) -> Markup {
    let w = &card.windows[index];
    let last = w.first_frame + w.frames.saturating_sub(1) * w.step;
    html! {
        p.muted {
            @if w.frames == 1 { "Frame " (w.first_frame) } @else { "Frames " (w.first_frame) " to " (last) }
            @if w.step > 1 { ", every " (w.step) }
            " · " (count(w.anchors)) " points in " (count(w.tiles)) " penumbra tiles · "
            @if w.picture > 0.0 { (percent(w.picture)) " of the picture scored, " }
            (percent(w.coverage)) " of the points that face the light"
            @if w.occluded > 0.0 {
                ", " span title="Points times frames in which something nearer hides the point: parallax, not disagreement" {
                    (percent(w.occluded)) " hidden in some frame"
                }
            }
            ", " (percent(w.disagreement)) " lost to disagreement"
            @match w.truth_secs {
                Some(secs) => { " · truth took " (number(secs)) " s" }
                None => " · truth from the cache"
            }
            @for note in &w.notes { " · " (note) }
        }
    }
}

fn variant(card: &Scorecard, book: &Book, window: usize, v: usize) -> Markup {
    let subject = &card.variants[v];
    let none = ResultCard::default();
    let scores = &card.result(window, v).unwrap_or(&none).scores;
    let end = |limit: f32| Axis::tick_label(Power::ONE, f64::from(limit));
    let limit = end(book.error_limit);
    let swim = end(book.swim_limits.get(&window).copied().unwrap_or(1.0));
    let shown = |slot| book.shown(window, slot);
    let place = &card.windows[window];
    let of =
        format!(" of {} ({}), {}, {}", subject.name, subject.calibration.label(), place.scene, place.path);
    html! {
        div.variant-row data-window=(window) data-variant=(v) {
            h4 {
                (swatch(Look::of(card, v))) a href={ "#variant-" (v) } { (subject.name) } " "
                span.muted { (subject.calibration.label()) }
            }
            p.muted.line { (plain_line(scores)) }
            div.strip-row {
                (figure(shown(Slot::Mask(v)), ("Shadow", &of), Some("shadow"), ("0", "1"), html! { (shadow_caption(scores)) }))
                (figure(shown(Slot::Error(v)), ("Signed error", &of), Some("error"), (&format!("−{limit}"), &format!("+{limit}")), html! { (error_caption(scores)) }))
                (figure(shown(Slot::Swim(v)), ("Swim map", &of), Some("swim"), ("0", &swim), html! { (swim_caption(scores)) @if let Some(caveat) = swim_caveat(card, v) { " " (caveat) "." } }))
            }
        }
    }
}

/// A picture with its colour bar and what to look for.
fn figure(
    shown: Option<&Shown>,
    (title, of): (&str, &str),
    bar: Option<&str>,
    ends: (&str, &str),
    caption: Markup,
) -> Markup {
    html! {
        figure {
            @match shown {
                Some(shown) => img src=(shown.source) width=(shown.width) height=(shown.height) alt={ (title) (of) } loading="lazy" decoding="async";,
                None => p.empty { "No picture." }
            }
            figcaption {
                div.legend-bar {
                    strong { (title) }
                    @if let Some(bar) = bar {
                        span.scale { (ends.0) span class={ "bar " (bar) } {} (ends.1) span.unit { "visibility" } }
                    }
                }
                p { (caption) }
            }
        }
    }
}

/// Scores that have no column, metric by metric.
fn further(card: &Scorecard, window: usize) -> Markup {
    let measured = |id: &str| card.results.iter().any(|r| r.window == window && r.scores.contains_key(id));
    let rows: Vec<_> = card.metrics.iter().filter(|m| !has_column(&m.id) && measured(&m.id)).collect();
    let text = |v: usize, id: &str| match card.result(window, v).and_then(|r| r.scores.get(id)) {
        Some(Measured::Score(score)) => free_score_about(*score, card.goal(id)),
        Some(Measured::NotMeasured { not_measured }) => not_measured.clone(),
        None => "not measured".into(),
    };
    let score = |v: usize, id: &str| card.result(window, v)?.scores.get(id)?.score();
    html! {
        @if !rows.is_empty() {
            div.wide {
                table.further {
                    thead {
                        tr {
                            td {}
                            @for v in &card.variants { th scope="col" { (v.name) small { (v.calibration.label()) } } }
                        }
                    }
                    tbody {
                        @for m in rows {
                            tr {
                                th scope="row" { a href={ "#metric-" (m.id) } { (m.name) } @if !m.unit.is_empty() { small { (m.unit) } } }
                                @for v in 0..card.variants.len() {
                                    @match score(v, &m.id) {
                                        Some(s) => td data-metric=(m.id) data-variant=(v) data-value=(s.value) title=(text(v, &m.id)) { span.value { (text(v, &m.id)) } },
                                        None => td { (text(v, &m.id)) },
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
