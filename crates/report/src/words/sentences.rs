//! The answer: three to six sentences made from the scores.
//!
//! Nothing is claimed that an interval does not carry; "could not be told apart" is an answer.

use super::span::merged;
use super::{Comparison, Sentence, any_swim_caveat, is_still, is_unresolved};
use crate::numbers::{free_number, free_score, number, percent};
use crate::{Scorecard, WindowCard};
use umbrage_metrics::Score;

/// Budgets that the cost sentence goes through, milliseconds a frame.
const BUDGETS_MS: [f64; 8] = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0];

/// From this share on the rest is within rounding of nothing.
const NEARLY_ALL: f64 = 0.995;

/// The sentences, in the order of their weight.
pub(crate) fn answer(card: &Scorecard) -> Vec<Sentence> {
    let all = Comparison { card, window: None };
    if card.windows.iter().all(|w| w.anchors == 0) {
        let text = "Nothing was scored: no anchors agreed in any view: check the camera. ";
        return vec![Sentence::default().text(text).section("scenes", "See the views.")];
    }
    let headline = super::headline::min_against_mask(card);
    let sentences =
        [Some(fidelity(all)), Some(motion(all)), headline, trade_off(all), Some(cost(all)), Some(trust(all))];
    sentences.into_iter().flatten().collect()
}

/// The variants that cannot be told from the lowest (which comes first).
fn leaders(all: Comparison, ranked: &[(usize, Score)], metric: &str) -> Vec<usize> {
    let Some(&(best, _)) = ranked.first() else { return Vec::new() };
    ranked.iter().map(|r| r.0).filter(|&v| v == best || !all.lower(best, v, metric)).collect()
}

/// The most faithful variant.
fn fidelity(all: Comparison) -> Sentence {
    let ranked = all.ranked("error");
    let leaders = leaders(all, &ranked, "error");
    let start = Sentence::default();
    let Some(&(best, lowest)) = ranked.first() else {
        return start
            .text(format!("ERROR was not measured: {}.", all.reason("error").unwrap_or("no result")));
    };
    if ranked.len() == 1 {
        let named = start.variant(all.card, best).text(" has an ERROR of ").number(free_score(lowest));
        return named.text(", and nothing to be compared with.");
    }
    if leaders.len() == ranked.len() {
        let text =
            format!("No difference in ERROR could be resolved between the {} variants; ", ranked.len());
        return start.text(text).text("the lowest estimate is ").number(free_score(lowest)).text(".");
    }
    if leaders.len() == 1 {
        let (second, next) = ranked[1];
        let named = start.variant(all.card, best).text(" is the most faithful: ERROR ");
        let against =
            named.number(free_score(lowest)).text(" against ").number(free_score(next)).text(" for ");
        return against.variant(all.card, second).text(", the next.");
    }
    let named = start.variant(all.card, best).text(" has the lowest ERROR, ").number(free_score(lowest));
    let tied = named.text(", but cannot be told apart from ").variants(all.card, &leaders[1..], 3);
    tied.text(".")
}

/// Who swims, who does not.
fn motion(all: Comparison) -> Sentence {
    let ranked = all.ranked("swimming");
    let pick = |keep: &dyn Fn(Score) -> bool| -> Vec<usize> {
        ranked.iter().filter(|r| keep(r.1)).map(|r| r.0).collect()
    };
    let start = Sentence::default();
    let Some(&(_, most)) = ranked.last() else {
        let reason = all.reason("swimming").unwrap_or("no result");
        return start.text(format!("SWIMMING was not measured: {reason}."));
    };
    let still = pick(&is_still);
    let unresolved = pick(&|s| !is_still(s) && is_unresolved(s));
    let mut parts: Vec<Sentence> = Vec::new();
    if !still.is_empty() {
        let verb =
            if merged(all.card, &still).len() == 1 { " does not swim at all" } else { " do not swim at all" };
        parts.push(Sentence::default().variants(all.card, &still, 4).text(verb));
    }
    if !unresolved.is_empty() {
        let part = Sentence::default().text("no swimming could be resolved in ");
        parts.push(part.variants(all.card, &unresolved, 4));
    }
    if !is_unresolved(most) {
        parts.push(calmest_and_wildest(all, &ranked, still.is_empty() && unresolved.is_empty()));
    }
    let mut sentence = start.section("time", "Under motion").text(", ");
    let count = parts.len();
    for (i, part) in parts.into_iter().enumerate() {
        sentence.0.extend(part.0);
        sentence = sentence.text(if i + 1 == count { "." } else { "; " });
    }
    match any_swim_caveat(all.card) {
        Some(caveat) => sentence.text(format!(" {caveat}; compare it with the same reading only.")),
        None => sentence,
    }
}

/// The most, and the least where everything swims.
fn calmest_and_wildest(all: Comparison, ranked: &[(usize, Score)], name_calmest: bool) -> Sentence {
    let mut sentence = Sentence::default();
    let Some(&(most, size)) = ranked.last() else { return sentence };
    let tied: Vec<usize> =
        ranked.iter().rev().map(|r| r.0).filter(|&v| v == most || !all.lower(v, most, "swimming")).collect();
    if name_calmest && tied.len() < ranked.len() {
        let calm = leaders(all, ranked, "swimming");
        let verb = if merged(all.card, &calm).len() == 1 { " swims least, " } else { " swim least, " };
        sentence = sentence.variants(all.card, &calm, 3).text(verb);
        sentence = sentence.number(free_score(ranked[0].1)).text("; ");
    }
    if tied.len() == ranked.len() && tied.len() > 1 {
        let text = "over all scenes, and corrected for all pairs, no difference in SWIMMING could be resolved; the largest estimate is ";
        return sentence.text(text).number(free_score(size));
    }
    // Both calibrations of a name are said once.
    let verb = match (tied.len(), merged(all.card, &tied).len(), ranked.len()) {
        (1, _, 1) => " swims, SWIMMING ",
        (1, ..) => " swims most, SWIMMING ",
        (_, 1, _) => " swims most, SWIMMING up to ",
        _ => " swim most, SWIMMING up to ",
    };
    sentence.variants(all.card, &tied, 3).text(verb).number(free_score(size))
}

/// What the most faithful one loses: to a calmer one, or to its largest part.
fn trade_off(all: Comparison) -> Option<Sentence> {
    let (best, _) = *all.ranked("error").first()?;
    let name = Sentence::default().variant(all.card, best);
    let swimming = all.score(best, "swimming").filter(|s| !is_unresolved(*s));
    // The most faithful among those that are calmer beyond doubt, and worse beyond doubt.
    let calmer = all
        .ranked("error")
        .into_iter()
        .find(|&(v, _)| swimming.is_some() && all.lower(v, best, "swimming") && all.lower(best, v, "error"));
    if let (Some((other, error)), Some(swimming)) = (calmer, swimming) {
        let paid = name.text(" pays for it under motion: SWIMMING ").number(free_score(swimming));
        let against = paid.text(", where ").variant(all.card, other).text(" has ");
        let against = match all.score(other, "swimming") {
            Some(calm) if is_still(calm) => against.text("none"),
            Some(calm) if is_unresolved(calm) => against.text("none that could be resolved"),
            calm => against.number(calm.map(free_score).unwrap_or_default()),
        };
        return Some(against.text(" at an ERROR of ").number(free_score(error)).text("."));
    }
    let scores = all.scores(best)?;
    let cell = super::line::dominant_cell(scores)?;
    let share = all.score(best, cell)?.value / all.score(best, "mse")?.value;
    let what = match cell {
        "noise" => "noise, which a filter could still reduce",
        "structured_static" => "static bands",
        "structured_moving" => "crawling bands",
        "smooth_moving" => "breathing penumbrae",
        _ => "a wrong penumbra profile (its width or its depth)",
    };
    let of = Sentence::default().text("Of the squared error of ").variant(all.card, best).text(", ");
    // Estimates of the other parts scatter about 0, and below it the largest is more than the whole.
    if share >= NEARLY_ALL {
        return Some(of.text(format!("nearly all is {what} (the other parts cannot be told from 0).")));
    }
    Some(of.number(percent(share)).text(format!(" is {what}.")))
}

/// The most faithful variant within each budget; on a software adapter, why there is none.
fn cost(all: Comparison) -> Sentence {
    let cost_of = |v: usize| all.card.overall_of(v)?.cost.as_ref();
    let priced: Vec<(usize, f64)> =
        all.ranked("error").iter().filter_map(|r| Some((r.0, cost_of(r.0)?.frame_ms_p95))).collect();
    let start = Sentence::default();
    if priced.is_empty() {
        let notes = all.card.overall.iter().find_map(|o| o.cost_note.as_deref());
        let reason = notes
            .map_or("needs a GPU", |n| n.trim_start_matches("not a cost: ").trim_start_matches("no cost: "));
        return start.section("cost", "Cost").text(format!(" was not measured: {reason}."));
    }
    let mut sentence = start.text("By ").section("cost", "cost").text(" (the 95th percentile of a frame): ");
    let mut chosen: Option<usize> = None;
    for budget in BUDGETS_MS {
        // `priced` is in order of ERROR: the first that fits is the most faithful that fits.
        let Some(&(v, _)) = priced.iter().find(|p| p.1 <= budget) else { continue };
        let better = chosen.is_none_or(|c| all.lower(v, c, "error"));
        if better {
            let joint = if chosen.is_some() { "; " } else { "" };
            sentence = sentence.text(format!("{joint}within {budget} ms ")).variant(all.card, v);
            let error = all.score(v, "error").map(free_score).unwrap_or_default();
            sentence = sentence.text(" (ERROR ").number(error).text(")");
            chosen = Some(v);
        }
    }
    let Some(last) = chosen else {
        return start_of_dear(all, &priced);
    };
    let dearer = priced.iter().any(|p| all.lower(p.0, last, "error"));
    sentence.text(if dearer {
        "; only beyond that is there anything better."
    } else {
        "; nothing dearer is resolvably better."
    })
}

/// When every variant is beyond the largest budget.
fn start_of_dear(all: Comparison, priced: &[(usize, f64)]) -> Sentence {
    let cheapest = priced.iter().min_by(|a, b| a.1.total_cmp(&b.1));
    let sentence = Sentence::default().text("Every variant costs more than 10 ms a frame");
    let Some(&(v, ms)) = cheapest else { return sentence.text(".") };
    sentence
        .text("; the cheapest is ")
        .variant(all.card, v)
        .text(", ")
        .number(format!("{} ms", number(ms)))
        .text(".")
}

/// How far the page can be trusted.
fn trust(all: Comparison) -> Sentence {
    let windows: Vec<_> = all.card.windows.iter().filter(|w| w.anchors > 0).collect();
    let noise = windows.iter().map(|w| w.reference_noise).sum::<f64>() / windows.len() as f64;
    let root = noise.max(0.0).sqrt();
    let start = covered(&windows).section("provenance", "truth");
    let noisy = start.text("'s own noise is ").number(free_number(root));
    match all.ranked("error").first() {
        Some((_, lowest)) if lowest.low > 0.0 => {
            let share = percent(root / lowest.value);
            noisy.text(" RMS, ").number(share).text(" of the lowest ERROR, and is not counted as error.")
        }
        _ => noisy.text(" RMS, and is not counted as error."),
    }
}

/// What was scored, of the pictures and of what could be scored at all: the larger number alone
/// would hide the sky and everything that faces away from the light.
fn covered(windows: &[&WindowCard]) -> Sentence {
    let Some(scored) = super::scored(windows.iter().copied()) else { return Sentence::default() };
    let start = Sentence::default().text("Scores cover ");
    let start = match scored.pictures {
        Some(pictures) => start.number(pictures).text(" of the pictures: "),
        None => start,
    };
    start.number(scored.facing).text(" of the surface points that face the light; ")
}
