//! The page that people open: one file, no network, no handler in the markup.
//!
//! In the order of its questions: what was run, which one to take, how sure is that, where and
//! when is it wrong, how to run it again, what the words mean.

mod columns;
mod definitions;
mod gate;
mod head;
mod provenance;
mod scenes;
mod script;
mod table;
mod viewer;

use crate::Scorecard;
use crate::book::Book;
use crate::gate::GateCard;
use crate::picture::HATCH;
use crate::plot::{pareto, per_frame, spectrum};
use crate::viewer::{Planes, inert};
use crate::words::answer;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::collections::BTreeMap;

const STYLE: &str = include_str!("page.css");
const VIEWER_STYLE: &str = include_str!("viewer.css");
/// Nothing is loaded from anywhere; pictures come from the page or from the folder beside it.
const POLICY: &str = "default-src 'none'; img-src data: file: 'self'; style-src 'unsafe-inline'; \
                      base-uri 'none'; form-action 'none'; script-src 'unsafe-inline'";
/// Planes beside the page are scripts: those of its own folder, and no others.
const BESIDE: &str = " file: 'self'";

/// What a page is made from.
#[derive(Clone, Copy)]
pub(crate) struct Sources<'a> {
    pub(crate) card: &'a Scorecard,
    pub(crate) book: &'a Book,
    pub(crate) gate: Option<&'a GateCard>,
    /// Pictures of what regressed, by their file: what an image's source says.
    pub(crate) crops: &'a BTreeMap<String, String>,
    pub(crate) planes: &'a Planes,
    /// What the script reads, from [`crate::viewer::describe`].
    pub(crate) description: &'a str,
}

/// The whole page.
pub(crate) fn page(sources: Sources) -> String {
    let Sources { card, book, gate, crops, planes, description } = sources;
    let policy = if planes.beside.is_some() { [POLICY, BESIDE].concat() } else { POLICY.into() };
    let hatch = HATCH.map(|[r, g, b]| format!("rgb({r} {g} {b})"));
    let hatch = format!(
        ".hatch{{background:repeating-linear-gradient(135deg,{0} 0 3px,{1} 3px 6px)}}",
        hatch[0], hatch[1]
    );
    let bars = ["shadow", "error", "swim"].iter().zip(&book.bars);
    let bars: String =
        bars.map(|(name, uri)| format!(".bar.{name}{{background-image:url({uri})}}")).collect();
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (card.provenance.suite) " · Umbrage" }
                style { (PreEscaped(STYLE)) (PreEscaped(VIEWER_STYLE)) (PreEscaped(bars)) (PreEscaped(hatch)) }
            }
            body {
                (head::head(card, gate))
                main {
                    (answers(card))
                    (table::section(card))
                    (cost(card))
                    (viewer::section(card, planes))
                    (scenes::section(card, book))
                    (time(card))
                    @if let Some(gate) = gate { (gate::section(gate, crops)) }
                    (provenance::section(card))
                    (definitions::section(card))
                }
                dialog #trace aria-label="Where a number comes from" {}
                (viewer::blocks(planes, description))
                @if let Some(gate) = gate {
                    script type="application/json" id="gate-data" { (PreEscaped(inert(&gate::cases(gate)))) }
                }
                script { (PreEscaped(script::script())) }
            }
        }
    }
    .into_string()
}

fn answers(card: &Scorecard) -> Markup {
    html! {
        section #answer {
            h2 { "The answer" }
            ul.answer { @for sentence in answer(card) { li { (sentence) } } }
        }
    }
}

fn cost(card: &Scorecard) -> Markup {
    let note = card.overall.iter().find_map(|o| o.cost_note.as_deref()).unwrap_or("needs a GPU");
    let plot = if card.provenance.adapter.is_cpu { None } else { pareto(card) };
    html! {
        section #cost {
            h2 { "Error against cost" }
            @if let Some(plot) = plot {
                p.lede {
                    "Down and to the left is better. The line joins the variants that nothing cheaper beats; "
                    "a larger mark swims more; a hollow mark is as printed, a solid one light-matched."
                }
                div.wide { (plot) }
            } @else {
                p.empty {
                    "No plot: " (note.trim_start_matches("no cost: ")) ". "
                    @if card.provenance.adapter.is_software() {
                        "Times on " (card.provenance.adapter.name) " say how fast this processor imitates a GPU, not "
                        "what a variant costs on one. Run the same command on a machine with a GPU to fill this in; "
                        "the scores hardly depend on it."
                    }
                }
            }
        }
    }
}

fn time(card: &Scorecard) -> Markup {
    html! {
        section #time {
            h2 { "Over time" }
            p.lede {
                "What each frame adds to SWIMMING. Light and scene stand still, so at a fixed point of a surface nothing "
                "should change: a calm variant is a line at 0. Shaded: 95 % intervals, where most frames can be told from 0, cut where they leave the plot. Dashed: as printed."
            }
            @for (index, window) in card.windows.iter().enumerate() {
                h3 { (window.scene) " · " (window.path) " " span.muted { (window.speed) } }
                @match per_frame(card, index) {
                    Some(plot) => div.wide { (plot) },
                    None => p.empty { (why_no_series(card, index)) },
                }
                @if let Some(plot) = spectrum(card, index) {
                    details {
                        summary { "What the noise is like" }
                        p.note { "A flat line is white noise. What falls to the left is blue: a filter, or the eye, removes it. What rises to the left is red: it looks like blotches." }
                        div.wide { (plot) }
                    }
                }
            }
        }
    }
}

fn why_no_series(card: &Scorecard, window: usize) -> String {
    let card_of = &card.windows[window];
    if card_of.anchors == 0 {
        return "No anchors agreed in this view: check the camera.".into();
    }
    if card_of.frames < 2 {
        return "Not measured: one frame only.".into();
    }
    let all = crate::words::Comparison { card, window: Some(window) };
    format!("Not measured: {}.", all.reason("swimming").unwrap_or("no variant has a series"))
}
