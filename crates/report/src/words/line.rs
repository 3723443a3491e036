//! A plain-language line for each variant: "noise-dominated; swims; penumbrae 9 % too narrow".

use super::{is_still, is_unresolved};
use crate::Measured;
use crate::numbers::spoken_percent;
use std::collections::BTreeMap;
use umbrage_metrics::Score;

/// A leak or a false shadow below half a step of an 8-bit picture is not worth a word.
const VISIBLE: f64 = 0.5 / 255.0;

/// The parts that the mean squared error adds up from, and what to call one that dominates.
const CELLS: [(&str, &str); 5] = [
    ("noise", "noise-dominated"),
    ("smooth_static", "mostly a wrong penumbra profile"),
    ("structured_static", "mostly static bands"),
    ("smooth_moving", "mostly breathing penumbrae"),
    ("structured_moving", "mostly crawling bands"),
];

/// What the scores of a variant say, or why they say nothing.
pub(crate) fn plain_line(scores: &BTreeMap<String, Measured>) -> String {
    let score = |id: &str| scores.get(id)?.score();
    let parts = [
        score("mse").and_then(|mse| dominant(&score, mse)),
        score("swimming").map(|s| swims(s, score("mse"))),
        score("width_ratio").map(width),
        score("light_leak").and_then(|s| share(s, ["leaks", "may leak"], "light into the umbra")),
        score("false_shadow").and_then(|s| share(s, ["takes", "may take"], "of the light from lit surfaces")),
    ];
    let line = parts.into_iter().flatten().collect::<Vec<_>>().join("; ");
    if line.is_empty() { "not measured".into() } else { line }
}

/// The cell of a variant that is certainly more than half of its squared error.
pub(crate) fn dominant_cell(scores: &BTreeMap<String, Measured>) -> Option<&'static str> {
    let score = |id: &str| scores.get(id)?.score();
    let mse = score("mse")?;
    CELLS.iter().find(|(id, _)| score(id).is_some_and(|s| dominates(s, mse))).map(|(id, _)| *id)
}

fn dominates(cell: Score, mse: Score) -> bool {
    mse.value > 0.0 && cell.low > 0.5 * mse.value
}

fn dominant(score: &impl Fn(&str) -> Option<Score>, mse: Score) -> Option<String> {
    let cell = CELLS.iter().find(|(id, _)| score(id).is_some_and(|s| dominates(s, mse)));
    Some(cell.map_or_else(|| "no part of its error dominates".to_string(), |(_, words)| (*words).into()))
}

fn swims(swimming: Score, mse: Option<Score>) -> String {
    if is_still(swimming) {
        return "does not swim".into();
    }
    if is_unresolved(swimming) {
        return "no swimming resolved".into();
    }
    // The upper end of the one against the lower end of the other: little even at worst.
    match mse {
        Some(mse) if swimming.high < 0.01 * mse.low => "swims little".into(),
        _ => "swims".into(),
    }
}

fn width(ratio: Score) -> String {
    if ratio.high < 1.0 {
        format!("penumbrae {} too narrow", spoken_percent(1.0 - ratio.value))
    } else if ratio.low > 1.0 {
        format!("penumbrae {} too wide", spoken_percent(ratio.value - 1.0))
    } else {
        "penumbra width right within its interval".into()
    }
}

/// What is visible for certain, or what may be; nothing when even the upper end is invisible.
fn share(score: Score, [does, may]: [&str; 2], what: &str) -> Option<String> {
    if score.low > VISIBLE {
        return Some(format!("{does} {} {what}", spoken_percent(score.value)));
    }
    (score.high > VISIBLE).then(|| format!("{may} up to {} {what}", spoken_percent(score.high)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(scores: &[(&str, f64, f64)]) -> String {
        let score = |&(id, value, half): &(&str, f64, f64)| {
            (id.to_string(), Score { value, low: value - half, high: value + half }.into())
        };
        plain_line(&scores.iter().map(score).collect())
    }

    #[test]
    fn says_what_dominates_only_when_the_interval_does() {
        let sure = [("mse", 1e-3, 1e-5), ("noise", 7e-4, 1e-5)];
        assert_eq!(line(&sure), "noise-dominated");
        let unsure = [("mse", 1e-3, 1e-5), ("noise", 5.1e-4, 1e-4)];
        assert_eq!(line(&unsure), "no part of its error dominates");
    }

    #[test]
    fn swimming_has_four_words() {
        let swim =
            |value, half| line(&[("mse", 1e-3, 1e-5), ("noise", 9e-4, 1e-6), ("swimming", value, half)]);
        assert_eq!(swim(0.0, 0.0), "noise-dominated; does not swim");
        assert_eq!(swim(1e-6, 2e-6), "noise-dominated; no swimming resolved");
        assert_eq!(swim(3e-6, 1e-6), "noise-dominated; swims little");
        assert_eq!(swim(5e-5, 1e-6), "noise-dominated; swims");
    }

    #[test]
    fn width_and_leak_obey_their_intervals() {
        assert_eq!(line(&[("width_ratio", 0.91, 0.02)]), "penumbrae 9\u{a0}% too narrow");
        assert_eq!(line(&[("width_ratio", 1.02, 0.03)]), "penumbra width right within its interval");
        assert_eq!(line(&[("light_leak", 0.001, 0.0009)]), "not measured", "invisible even at its upper end");
        let unsure = line(&[("light_leak", 0.019_065, 0.017_845), ("false_shadow", 0.001, 0.004)]);
        assert_eq!(
            unsure,
            "may leak up to 4\u{a0}% light into the umbra; may take up to 0.5\u{a0}% of the light from lit surfaces"
        );
        assert_eq!(line(&[("light_leak", 0.012, 0.002)]), "leaks 1.2\u{a0}% light into the umbra");
    }
}
