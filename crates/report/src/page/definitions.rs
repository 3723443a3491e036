//! What the words mean.

use crate::{Direction, Scorecard};
use maud::{Markup, html};

pub(super) fn section(card: &Scorecard) -> Markup {
    html! {
        section #definitions {
            h2 { "Definitions" }
            p.lede {
                "Visibility is the unoccluded fraction of the light, 1 = fully lit. Every interval is a 95 % interval over "
                "tiles of the picture."
            }
            dl.definitions {
                @for m in &card.metrics {
                    dt id={ "metric-" (m.id) } { (m.name) " " span.muted { (direction(m.direction)) @if !m.unit.is_empty() { ", " (m.unit) } @if !m.range.is_empty() { ", " (m.range) } } }
                    dd {
                        p { (m.definition) }
                        @if !m.formula.is_empty() { p.formula { (m.formula) } }
                        @if !m.blind_spot.is_empty() { p.muted { "Blind spot: " (m.blind_spot) } }
                        @if !m.source.is_empty() { p.muted { "Source: " (m.source) } }
                    }
                }
            }
        }
    }
}

fn direction(direction: Direction) -> &'static str {
    match direction {
        Direction::Lower => "less is better",
        Direction::One => "1 is right",
        Direction::Descriptive => "describes",
    }
}
