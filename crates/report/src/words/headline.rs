//! The first seed document's own comparison: the min filter does not swim, the penumbra mask is the
//! more faithful. Measured on its own kind of scene where that was run, otherwise over everything.
//!
//! It was planned before anything was measured, so each of its differences is judged by its own
//! 95 % interval. `PairedCard::resolved` is stricter: it pays for all the pairs that nobody asked
//! about beforehand.

use super::Sentence;
use crate::numbers::free_score;
use crate::{Calibration, PairedCard, Scorecard};
use umbrage_metrics::Score;

/// The scene that stands for the document's situation.
const SCENE: &str = "colonnade";

/// What a paired difference says about a claim "a is lower than b".
#[derive(Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Holds,
    Fails,
    Unresolved,
}

/// One sentence about both halves of the comparison; none when either variant was not run.
pub(crate) fn min_against_mask(card: &Scorecard) -> Option<Sentence> {
    let find = |name: &str| {
        card.variants.iter().position(|v| v.name == name && v.calibration == Calibration::LightMatched)
    };
    let (min, mask) = (find("chss-min")?, find("chss-mask")?);
    let on_scene: Vec<Option<usize>> =
        (0..card.windows.len()).filter(|&w| card.windows[w].scene == SCENE).map(Some).collect();
    let places = if on_scene.is_empty() { vec![None] } else { on_scene };
    let swims = clause(card, (min, mask, "swimming"), &places)?;
    let errs = clause(card, (mask, min, "error"), &places)?;
    let mut sentence = Sentence::default().text("The first document's comparison. \"");
    sentence = sentence.variant(card, min).text(" swims less than ").variant(card, mask).text("\": ");
    sentence.0.extend(swims.0);
    sentence = sentence.text(". \"The mask has the lower ERROR\": ");
    sentence.0.extend(errs.0);
    Some(sentence.text(". (Differences are the first minus the second.)"))
}

/// "holds in colonnade P1 (-(42 +- 20)e-6) and P4 (...)", place by place.
fn clause(
    card: &Scorecard,
    (a, b, metric): (usize, usize, &str),
    places: &[Option<usize>],
) -> Option<Sentence> {
    let mut clause = Sentence::default();
    let mut said = 0;
    for &window in places {
        let Some(difference) = difference(card, (a, b, metric), window) else { continue };
        let verdict = match verdict(difference) {
            Verdict::Holds => "holds",
            Verdict::Fails => "does not hold",
            Verdict::Unresolved => "cannot be resolved",
        };
        let place = match window {
            Some(w) => format!(" on {} {} (", card.windows[w].scene, card.windows[w].path),
            None => " over all scenes (".to_string(),
        };
        let start = if said == 0 { "" } else { ", " };
        clause = clause.text(format!("{start}{verdict}{place}")).number(free_score(difference)).text(")");
        said += 1;
    }
    (said > 0).then_some(clause)
}

/// Value of a minus value of b, whichever way round it was stored.
fn difference(
    card: &Scorecard,
    (a, b, metric): (usize, usize, &str),
    window: Option<usize>,
) -> Option<Score> {
    let is = |p: &PairedCard, x, y| p.window == window && p.metric == metric && (p.a, p.b) == (x, y);
    card.paired.iter().find_map(|p| {
        let Score { value, low, high } = p.difference;
        if is(p, a, b) {
            Some(p.difference)
        } else {
            is(p, b, a).then_some(Score { value: -value, low: -high, high: -low })
        }
    })
}

/// By the difference's own interval: whether it contains 0.
fn verdict(difference: Score) -> Verdict {
    if difference.high < 0.0 {
        Verdict::Holds
    } else if difference.low > 0.0 {
        Verdict::Fails
    } else {
        Verdict::Unresolved
    }
}
