//! What must be said beside SWIMMING of frames that another program rendered.

use crate::{Calibration, Measured, Scorecard};

/// Of one variant; nothing of our own, which are read at anchors and with several seeds.
pub(crate) fn swim_caveat(card: &Scorecard, variant: usize) -> Option<&'static str> {
    if card.variants[variant].calibration != Calibration::Elsewhere {
        return None;
    }
    let of = || {
        let results = card.results.iter().filter(move |r| r.variant == variant).map(|r| &r.scores);
        results.chain(card.overall_of(variant).map(|o| &o.scores))
    };
    let measured = |id: &str| of().any(|scores| scores.get(id).is_some_and(|m| m.score().is_some()));
    // One picture, or frames without cameras: nothing was followed, and nothing is to be said.
    if !measured("swimming") {
        return None;
    }
    let one_take = of().any(|scores| matches!(scores.get("noise"), Some(Measured::NotMeasured { .. })));
    Some(if one_take {
        "SWIMMING here holds the noise of its one take, and edge crawl: more takes would tell noise apart"
    } else {
        "SWIMMING here holds edge crawl: it was read at pixels, not at surface points"
    })
}

/// The caveat of the first variant that has one.
pub(crate) fn any_swim_caveat(card: &Scorecard) -> Option<&'static str> {
    (0..card.variants.len()).find_map(|v| swim_caveat(card, v))
}
