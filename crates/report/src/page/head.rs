//! The head: what this page is about, and how far it reaches.

use crate::Scorecard;
use crate::numbers::{free_number, percent};
use maud::{Markup, html};

const SECTIONS: [(&str, &str); 7] = [
    ("answer", "Answer"),
    ("table", "Table"),
    ("cost", "Cost"),
    ("scenes", "Scenes"),
    ("time", "Time"),
    ("provenance", "Provenance"),
    ("definitions", "Definitions"),
];

pub(super) fn head(card: &Scorecard) -> Markup {
    let p = &card.provenance;
    html! {
        header {
            nav aria-label="Sections" {
                span.mark-name { "Umbrage" }
                @for (id, name) in SECTIONS { a href={ "#" (id) } { (name) } }
            }
            h1 { "Soft shadows against the truth" }
            p.subject {
                strong { (p.suite) } " · " (card.variants.len()) " variants · " (card.windows.len())
                @if card.windows.len() == 1 { " window" } @else { " windows" }
                " · " (p.date)
            }
            dl.facts {
                (fact("Adapter", html! { (p.adapter.name) @if p.adapter.is_cpu { " (software)" } }))
                (fact("Driver", html! { (p.adapter.backend) ", " (p.adapter.driver) }))
                (fact("Picture", html! { (p.width) " × " (p.height) " px" }))
                (fact("Window", html! { (p.frames) @if p.frames == 1 { " frame" } @else { " frames" } ", " (p.seeds) " seeds" }))
                (fact("Truth", html! { "2 × " (p.truth.samples_per_half) " samples a point" }))
                (fact("Program", html! { "umbrage " (p.tool_version) }))
                (fact("Scored", html! { (coverage(card)) }))
                (fact("Truth's own noise", html! { (noise(card)) }))
            }
        }
    }
}

fn fact(name: &str, value: Markup) -> Markup {
    html! { div { dt { (name) } dd { (value) } } }
}

/// The share of the picture that was scored, over windows.
fn coverage(card: &Scorecard) -> String {
    let shares = || card.windows.iter().map(|w| w.coverage);
    let (low, high) = (shares().fold(f64::INFINITY, f64::min), shares().fold(0.0, f64::max));
    if card.windows.is_empty() {
        return "nothing".into();
    }
    let lost = card.windows.iter().map(|w| w.disagreement).fold(0.0, f64::max);
    let range = if low == high { percent(low) } else { format!("{} to {}", percent(low), percent(high)) };
    format!("{range} of the points (at most {} lost to disagreement)", percent(lost))
}

/// The root of truth's own error, pooled over windows that were scored.
fn noise(card: &Scorecard) -> String {
    let scored: Vec<f64> = card.windows.iter().filter(|w| w.anchors > 0).map(|w| w.reference_noise).collect();
    if scored.is_empty() {
        return "not measured".into();
    }
    let mean = scored.iter().sum::<f64>() / scored.len() as f64;
    format!("{} RMS, not counted as error", free_number(mean.max(0.0).sqrt()))
}
