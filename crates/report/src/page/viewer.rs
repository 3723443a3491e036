//! The viewer's frame: the script fills it. Without a script the pictures below are what there is.

use crate::Scorecard;
use crate::viewer::Planes;
use crate::words::any_swim_caveat;
use maud::{Markup, PreEscaped, html};

pub(super) fn section(card: &Scorecard, planes: &Planes) -> Markup {
    html! {
        section #viewer {
            h2 { "Viewer" }
            @if planes.frames.is_empty() {
                p.empty { "No pictures were stored: there is nothing to look at." }
            } @else {
                p.lede {
                    "Any two pictures, one over the other or side by side, down to single pixels and their values. "
                    "Over the frames of a path every surface point stays where it is: what still moves is swimming. Press "
                    kbd { "?" } " for the keys."
                }
                noscript { p.empty { "The viewer needs JavaScript; the pictures below do not." } }
                div.viewer hidden { (choices()) (stage()) (looks()) (transport(card, planes)) (findings()) (help()) }
            }
        }
    }
}

fn button(action: &str, text: &str, title: &str) -> Markup {
    html! { button type="button" data-do=(action) title=(title) { (text) } }
}

fn choices() -> Markup {
    html! {
        div.choices {
            label { "Scene " select.where {} }
            label { "Left " select.left {} }
            label { "Right " select.right {} }
            (button("swap", "⇄ Swap", "Exchange left and right (x)"))
            fieldset {
                legend { "How" }
                @for (value, text) in [("slider", "slider"), ("flip", "flip"), ("side", "side by side"), ("difference", "difference")] {
                    label { input type="radio" name="v-mode" value=(value) checked[value == "slider"]; " " (text) }
                }
            }
            label { "Split " input.split type="range" min="0" max="1" step="0.005"; }
        }
    }
}

fn stage() -> Markup {
    html! {
        div.stage-frame {
            div.stage tabindex="0" role="application" aria-label="Pictures: arrows move the cursor, plus and minus zoom, question mark shows all keys" {
                canvas {}
                div.split-line hidden {}
            }
            span.tag.left {}
            span.tag.right {}
            p.refusal role="status" hidden {}
        }
        div.legends {}
        div.captions {}
    }
}

fn looks() -> Markup {
    html! {
        div.looks {
            (button("zoom-out", "−", "Zoom out (−)")) (button("zoom-in", "+", "Zoom in (+)")) (button("fit", "Fit", "The whole picture (0)"))
            (button("tiles", "Tiles", "The tiles that scores are made of (g)"))
            label { "Exposure " input.exposure type="range" min="-8" max="10" step="0.5"; " " output.exposure-value {} }
            label { "Error range ± " input.error-limit type="number" min="0" step="any"; }
            label { "Swim range " input.swim-limit type="number" min="0" step="any"; }
            (button("reset", "Reset", "Exposure and ranges as printed"))
            (button("help", "Keys ?", "All keys (?)"))
        }
    }
}

fn transport(card: &Scorecard, planes: &Planes) -> Markup {
    html! {
        p.no-time.muted hidden {}
        div.transport hidden {
            div.tape {
                (button("back", "◂", "A frame back (comma)")) (button("play", "Play", "Play or pause (space)")) (button("forward", "▸", "A frame on (full stop)"))
                label.scrub { span.frame-name {} " " input.frame type="range" min="0" step="1" aria-label="Frame"; }
                label { "Frames a second " select.speed { option { "4" } option selected { "10" } option { "30" } option { "60" } } }
                label title="See each frame from its own camera (m)" { input.moving type="checkbox"; " move the camera" }
                (button("follow", "Follow this point", "Pin the point under the cursor; the view goes with it (p)"))
                (button("still", "As shown", "Back to the middle frame, as a game shows it (Escape)"))
            }
            p.note {
                "Frames show each variant at the surface points of the middle frame, "
                @if card.provenance.adapter.rendered_here() { "its pattern as a game ships it. " } @else { "as its program rendered it, read at pixels. " }
                @if let Some(caveat) = any_swim_caveat(card) { (caveat) ". " }
                "Where a variant has no stored frames, its middle frame is shown."
                @if planes.beside.is_none() {
                    " In this single file frames are in steps of 1/512, and those of variants as printed are left out; "
                    code { "--report dir" } " keeps all of them as they are."
                }
            }
            div.wide.swimming {}
        }
    }
}

fn findings() -> Markup {
    html! {
        div.findings {
            div.inspector {
                h3 { "At this pixel" }
                p.hint.muted { "Point at the picture, or move the cursor with the arrow keys." }
                div.found hidden {
                    dl {}
                    div.wide tabindex="0" role="region" aria-label="Values of every variant at this pixel" { table.plain {
                        thead { tr { th scope="col" { "variant" } th scope="col" { "shadow" } th scope="col" { "error" } th scope="col" { "swim" } } }
                        tbody {}
                    } }
                }
            }
            figure.point hidden {
                figcaption { strong { "This point over the frames" } p { "The line in its band is the truth with twice its standard error; colours are those of the table. A calm variant is a level line." } }
                svg.plot viewBox="0 0 620 250" role="img" {}
            }
            div.tile-scores hidden {
                h3.tile-name {}
                p.note { "ERROR is a root (visibility); its parts are in millionths (visibility squared). Estimates of no error scatter about 0." }
                p.note.no-penumbra hidden { "This tile has no penumbra: nothing is scored in it." }
                div.wide tabindex="0" role="region" aria-label="Scores of every variant in this tile" {
                    table.plain { thead { tr {} } tbody {} }
                }
            }
        }
    }
}

const KEYS: [(&str, &str); 17] = [
    (
        "1 – 9, shift-0 – 9",
        "a variant into the right slot, in the order of the choices beside \"Right\"; with shift the 10th to the 19th",
    ),
    ("R", "the truth into the left slot"),
    ("D", "difference: right minus left"),
    ("F", "flip: hold for the right picture (or point at it)"),
    ("S, B", "slider; side by side"),
    ("X", "exchange left and right"),
    ("E, shift-E", "exposure up, down by half a stop"),
    ("G", "grid of tiles"),
    ("space", "play, pause"),
    (",  .", "a frame back, on"),
    (
        "P",
        "follow the point under the cursor: it stays in the middle while the camera moves; again to let it go",
    ),
    ("M", "move the camera, or hold it still"),
    ("arrows", "cursor by a pixel; with shift by ten"),
    (
        "+  −  0",
        "zoom in, out, whole picture; the wheel zooms once the picture has been clicked. From 8 times on pixels have borders and \
         numbers with as many digits as fit; the line of colour bars says in what steps",
    ),
    ("double click, drag", "zoom in, pan"),
    ("Esc", "back to the middle frame; closes this"),
    ("?", "these keys"),
];

fn help() -> Markup {
    html! {
        dialog.help aria-label="Keys" {
            dl { @for (keys, what) in KEYS { dt { kbd { (keys) } } dd { (what) } } }
        }
    }
}

/// The planes and their description, in blocks that no browser runs.
pub(super) fn blocks(planes: &Planes, description: &str) -> Markup {
    html! {
        script type="application/json" id="viewer-data" { (PreEscaped(description)) }
        // Keys and base64 hold nothing to escape.
        @for (key, text) in &planes.inline {
            script type="text/plain" id={ "plane-" (key) } { (PreEscaped(text)) }
        }
    }
}
