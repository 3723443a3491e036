//! Captions: what to look for in a picture, from what was measured.

use super::line::dominant_cell;
use super::{is_still, is_unresolved};
use crate::Measured;
use crate::numbers::{free_score, number};
use std::collections::BTreeMap;
use umbrage_metrics::Score;

/// Under a variant's shadow.
pub(crate) fn shadow_caption(scores: &BTreeMap<String, Measured>) -> String {
    match dominant_cell(scores) {
        Some("noise") => "Compare the softness of its edges with the truth; its grain is that of one frame.",
        Some("structured_static" | "structured_moving") => {
            "Bands parallel to the edges: the truth is smooth there."
        }
        Some("smooth_static" | "smooth_moving") => "Compare how wide its soft edges are with the truth's.",
        _ => "Compare its edges with the truth's: where do they start, where do they end?",
    }
    .into()
}

/// Under its signed error.
pub(crate) fn error_caption(scores: &BTreeMap<String, Measured>) -> String {
    let size = match scores.get("error") {
        Some(Measured::Score(error)) => format!("ERROR {}. ", free_score(*error)),
        Some(Measured::NotMeasured { not_measured }) => format!("ERROR not measured: {not_measured}. "),
        None => String::new(),
    };
    let width = scores.get("width_ratio").and_then(Measured::score);
    let sides = |ratio: Score, sides: &str| {
        format!("Penumbrae of {} times the true width: {sides}.", number(ratio.value))
    };
    let hint = match width {
        Some(ratio) if ratio.high < 1.0 => {
            sides(ratio, "blue on the dark side of an edge, red on its light side")
        }
        Some(ratio) if ratio.low > 1.0 => {
            sides(ratio, "red on the dark side of an edge, blue on its light side")
        }
        _ => "Stripes of both colours along an edge are a wrong width; one colour alone is a shifted edge, \
              a missed blocker or a leak."
            .into(),
    };
    size + &hint
}

/// Under its swim map.
pub(crate) fn swim_caption(scores: &BTreeMap<String, Measured>) -> String {
    match scores.get("swimming") {
        Some(Measured::Score(s)) if is_still(*s) => {
            "SWIMMING 0: it depends on the place in the world alone. The map must be black.".into()
        }
        Some(Measured::Score(s)) if is_unresolved(*s) => format!(
            "SWIMMING {}: cannot be told from 0. Grain without shape is the estimator's own noise.",
            free_score(*s)
        ),
        Some(Measured::Score(s)) => {
            format!("SWIMMING {}. Bright places crawl or breathe as the camera moves.", free_score(*s))
        }
        Some(Measured::NotMeasured { not_measured }) => format!("SWIMMING not measured: {not_measured}."),
        None => "SWIMMING not measured.".into(),
    }
}
