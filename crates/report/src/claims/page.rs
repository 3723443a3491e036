//! The claims page: one file, no network, no script.

use super::card::{ClaimCard, ClaimPart, ClaimsCard, DocumentTime, Verdict};
use super::words::{counts, effect, expectation, extent, facts, unmeasured, value};
use crate::numbers::number;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::collections::BTreeMap;

const STYLE: &str = concat!(include_str!("../page/page.css"), include_str!("claims.css"));
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";

/// The whole page; crops go into it.
pub(super) fn page(card: &ClaimsCard, pngs: &BTreeMap<String, Vec<u8>>) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "Claims · Umbrage" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                (head(card))
                main {
                    (overview(card))
                    section #claims {
                        h2 { "One by one" }
                        @for claim in &card.claims { (section(claim, pngs.get(&claim.id))) }
                    }
                    (times(&card.times))
                    (provenance(card))
                }
            }
        }
    }
    .into_string()
}

fn head(card: &ClaimsCard) -> Markup {
    html! {
        header {
            nav aria-label="Sections" {
                span.mark-name { "Umbrage" }
                a href="#overview" { "Overview" } a href="#claims" { "Claims" }
                @if !card.times.is_empty() { a href="#times" { "Times" } }
                a href="#provenance" { "Provenance" }
            }
            h1 { "What the documents say, measured" }
            p.subject { strong { (card.claims.len()) " claims" } " · " (card.provenance.date) }
            ul.verdicts {
                @for (verdict, count) in counts(card) {
                    li { strong { (count) } " " (chip(verdict)) }
                }
            }
        }
    }
}

fn chip(verdict: Verdict) -> Markup {
    let class = match verdict {
        Verdict::Holds => "chip holds",
        Verdict::HoldsPartly => "chip partly",
        Verdict::Fails => "chip fails",
        _ => "chip open",
    };
    html! { span class=(class) { (verdict.label()) } }
}

fn overview(card: &ClaimsCard) -> Markup {
    html! {
        section #overview {
            h2 { "Overview" }
            p.lede {
                "Verdicts follow from 95 % intervals, paired over the same tiles, frames and patterns, by a rule that was written "
                "down before the results. A claim that fails is a finding."
            }
            div.wide {
                table.plain {
                    thead { tr { th { "claim" } th { "says" } th { "document" } th { "verdict" } } }
                    tbody {
                        @for claim in &card.claims {
                            tr {
                                th scope="row" { a href={ "#" (anchor(claim)) } { (claim.id) } }
                                td { (claim.statement) } td { (claim.document) }
                                td { (chip(claim.verdict)) @if let Some(open) = unmeasured(claim) { small { (open) } } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Safe as an id, whatever a claim is called.
fn anchor(claim: &ClaimCard) -> String {
    let safe: String = claim.id.chars().filter(char::is_ascii_alphanumeric).collect();
    format!("claim-{safe}")
}

fn section(claim: &ClaimCard, png: Option<&Vec<u8>>) -> Markup {
    html! {
        article.claim id=(anchor(claim)) {
            h3 { (claim.id) " " (chip(claim.verdict)) " " span.muted { (claim.document) } }
            p { (claim.statement) }
            @if let Some(note) = &claim.note { p.note { (note) } }
            div.wide {
                table.plain.parts {
                    thead { tr {
                        th { "part" } th { "number" } th { "A" } th { "B" } th { "effect" } th { "expected" } th { "outcome" } th { "from" }
                    } }
                    tbody { @for part in &claim.parts { (row(part)) } }
                }
            }
            @if let (Some(png), Some(caption)) = (png, &claim.crop_caption) {
                figure {
                    img src={ "data:image/png;base64," (base64::encode(png)) } alt=(caption) loading="lazy";
                    figcaption { (caption) }
                }
            }
        }
    }
}

fn row(part: &ClaimPart) -> Markup {
    html! {
        tr {
            td { (part.says) }
            td { (part.number) }
            td { (part.a) small { (value(part.value_a)) } }
            td { (part.b) small { (value(part.value_b)) } }
            td.effect { @match part.effect { Some(e) => (effect(part.effect_kind, e)), None => "–" } }
            td { (expectation(part)) @if let Some(why) = &part.margin_reason { small { (why) } } }
            td { (part.outcome.label()) @if let Some(reason) = &part.reason { small { (reason) } } }
            td {
                (extent(part))
                @if part.per_place.is_empty() { small { (part.places.join("; ")) } }
                @for place in &part.per_place { small { (place.place) ": " (effect(part.effect_kind, place.effect)) } }
            }
        }
    }
}

fn times(times: &[DocumentTime]) -> Markup {
    if times.is_empty() {
        return html! {};
    }
    html! {
        section #times {
            h2 { "The first document's Table 1" }
            p.lede { "Times on a GTX 660 at 1920 × 1080 with a 2048² map, and as ratios to the plain filter beside ours." }
            div.wide {
                table.plain {
                    thead { tr { th { "what" } th { "document ms" } th { "document ratio" } th { "ours" } th { "ratio" } } }
                    tbody {
                        @for t in times {
                            tr {
                                th scope="row" { (t.what) } td { (number(t.document_ms)) } td { (number(t.document_ratio)) } td { (t.ours) }
                                td {
                                    @match t.ratio {
                                        Some(s) => { (number(s.value)) " [" (number(s.low)) " to " (number(s.high)) "]" },
                                        None => "needs a GPU",
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

fn provenance(card: &ClaimsCard) -> Markup {
    html! {
        section #provenance {
            h2 { "Provenance" }
            pre.command tabindex="0" { code { (card.provenance.command) } }
            dl.facts { @for (name, fact) in facts(card) { div { dt { (name) } dd { (fact) } } } }
            @for note in &card.provenance.notes { p.note { (note) } }
        }
    }
}
