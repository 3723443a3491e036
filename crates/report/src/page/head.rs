//! The head: what this page is about, and how far it reaches.

use super::gate::chip;
use super::provenance::seeds;
use crate::Scorecard;
use crate::gate::GateCard;
use crate::numbers::{free_number, percent};
use crate::words::scored;
use maud::{Markup, html};

const SECTIONS: [(&str, &str); 8] = [
    ("answer", "Answer"),
    ("table", "Table"),
    ("cost", "Cost"),
    ("viewer", "Viewer"),
    ("scenes", "Scenes"),
    ("time", "Time"),
    ("provenance", "Provenance"),
    ("definitions", "Definitions"),
];

pub(super) fn head(card: &Scorecard, gate: Option<&GateCard>) -> Markup {
    let p = &card.provenance;
    html! {
        header {
            nav aria-label="Sections" {
                span.mark-name { "Umbrage" }
                @for (id, name) in SECTIONS {
                    @if id == "provenance" && gate.is_some() { a href="#gate" { "Gate" } }
                    a href={ "#" (id) } { (name) }
                }
            }
            h1 { "Soft shadows against the truth" }
            p.subject {
                strong { (p.suite) } " · " (card.variants.len()) @if card.variants.len() == 1 { " variant" } @else { " variants" } " · " (card.windows.len())
                @if card.windows.len() == 1 { " window" } @else { " windows" }
                " · " (p.date)
            }
            @if let Some(gate) = gate { p { a href="#gate" { (chip(gate)) } } }
            dl.facts {
                (fact("Adapter", html! { (p.adapter.name) @if p.adapter.is_software() { " (software)" } }))
                @if p.adapter.rendered_here() {
                    (fact("Driver", html! { (p.adapter.backend) ", " (p.adapter.driver) }))
                }
                (fact("Picture", html! { (p.width) " × " (p.height) " px" }))
                (fact("Window", html! { (p.frames) @if p.frames == 1 { " frame" } @else { " frames" } ", " (p.seeds) " " (seeds(p)) }))
                (fact("Truth", html! {
                    @if p.truth.samples_per_half == 0 { "frames, as given" } @else { "2 × " (p.truth.samples_per_half) " samples a point" }
                }))
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

/// The shares that were scored, over windows.
fn coverage(card: &Scorecard) -> String {
    let Some(scored) = scored(card.windows.iter()) else { return "nothing".into() };
    let lost = card.windows.iter().map(|w| w.disagreement).fold(0.0, f64::max);
    let pictures = scored.pictures.map(|range| format!("{range} of the pictures: ")).unwrap_or_default();
    let facing = scored.facing;
    format!(
        "{pictures}{facing} of the points that face the light (at most {} lost to disagreement)",
        percent(lost)
    )
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
