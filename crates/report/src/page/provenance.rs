//! Everything needed to run it again.

use crate::numbers::number;
use crate::{Provenance, Scorecard, VariantCard};
use maud::{Markup, html};

pub(super) fn section(card: &Scorecard) -> Markup {
    let p = &card.provenance;
    html! {
        section #provenance {
            h2 { "Provenance" }
            p.lede { "All of this is part of the score: only equal settings compare. The same command on the same inputs gives the same scores." }
            pre.command tabindex="0" { code { (p.command) } }
            button.copy type="button" hidden { "Copy the command" }
            dl.facts {
                (fact("Adapter", &p.adapter.name))
                @if p.adapter.rendered_here() {
                    (fact("Driver", &format!("{}, {} ({})", p.adapter.driver, p.adapter.backend, p.adapter.device_type)))
                }
                (fact("Program", &format!("umbrage {}", p.tool_version)))
                (fact("Started", &p.date))
                (fact("Picture", &format!("{} × {} px, tiles of {} px", p.width, p.height, p.tile_px)))
                (fact("Window", &format!("T = {} frames, S = {} {}", p.frames, p.seeds, seeds(p))))
                (fact("Truth", &truth(p)))
                @if p.shadow_map_texels > 0 {
                    (fact("Shadow map", &format!("{0} × {0} texels", p.shadow_map_texels)))
                } @else {
                    (fact("Shadow map", "unknown: rendered elsewhere"))
                }
            }
            @for note in &p.notes { p.note { (note) } }
            @if !p.scenes.is_empty() { h3 { "Scenes" } div.wide {
                table.plain {
                    thead { tr { th { "scene" } th { "light" } th { "shadow map" } th { "content" } th { "notes" } } }
                    tbody {
                        @for s in &p.scenes {
                            tr {
                                th scope="row" { (s.name) } td { (s.light) } td { (s.shadow_map) }
                                td { code { (s.content_hash) } } td { (s.notes.join("; ")) }
                            }
                        }
                    }
                }
            } }
            h3 { "Variants" }
            @for (v, variant) in card.variants.iter().enumerate() { (settings(card, v, variant)) }
        }
    }
}

/// What the S of a window counts.
pub(super) fn seeds(p: &Provenance) -> &'static str {
    match (p.adapter.rendered_here(), p.seeds) {
        (true, 1) => "seed",
        (true, _) => "seeds",
        (false, 1) => "take",
        (false, _) => "takes",
    }
}

/// Frames that are taken for the truth have no samples.
fn truth(p: &Provenance) -> String {
    let t = &p.truth;
    match t.samples_per_half {
        0 => t.method.clone(),
        n => format!("{}; 2 × {n} samples a point, basis {}", t.method, t.basis_samples),
    }
}

fn fact(name: &str, value: &str) -> Markup {
    html! { div { dt { (name) } dd { (value) } } }
}

fn settings(card: &Scorecard, v: usize, variant: &VariantCard) -> Markup {
    let s = &variant.settings;
    let fixed = [
        ("constant bias", &s.bias_constant),
        ("normal-offset bias", &s.bias_normal_offset),
        ("receiver-plane bias", &s.bias_receiver_plane),
        ("search radius", &s.search_radius),
        ("kernel cap", &s.kernel_cap),
        ("radius means", &s.radius_convention),
        ("outside the map", &s.outside_the_map),
    ];
    let cost = card.overall_of(v).and_then(|o| o.cost.as_ref());
    html! {
        details.settings {
            summary { strong { (variant.name) } ", " (variant.calibration.label()) ": " (variant.sentence) }
            dl.facts {
                // Another program's settings are its own.
                @for (name, value) in fixed.into_iter().filter(|f| !f.1.is_empty()) { (fact(name, value)) }
                @for (name, value) in &s.more { (fact(name, value)) }
                (fact("source", &variant.source))
                @if let Some(cost) = cost {
                    @for pass in &cost.passes { (fact(&format!("pass {}", pass.name), &format!("{} ms", number(pass.median_ms)))) }
                    @if let Some(once) = cost.once_per_scene_ms { (fact("once a scene", &format!("{} ms", number(once)))) }
                }
            }
        }
    }
}
