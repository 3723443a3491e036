//! What is too small to matter: the `[gate]` table of a suite.

use super::card::short;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use umbrage_metrics::{GATED, Margin, PooledNumber};

/// Margins by score: `error = { absolute = 2e-4, relative = 0.01 }`, of which the larger counts. What is not
/// named has its usual margin.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Margins {
    /// For every scene.
    pub all: BTreeMap<String, MarginCard>,
    /// For one scene, in place of the margin for every scene.
    pub scenes: BTreeMap<String, BTreeMap<String, MarginCard>>,
}

/// The larger of the two counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MarginCard {
    /// In the score's own unit.
    #[serde(default)]
    pub absolute: f64,
    /// Part of the baseline's value, 0.02 = 2 %.
    #[serde(default)]
    pub relative: f64,
}

/// The names of the scores that a gate looks at.
pub fn gated() -> impl Iterator<Item = (&'static str, PooledNumber)> {
    GATED.into_iter().map(|number| (id(number), number))
}

fn words(margin: Margin) -> String {
    format!("{} or {} %", short(margin.absolute), short(100.0 * margin.relative))
}

fn id(number: PooledNumber) -> &'static str {
    match number {
        PooledNumber::Cell(quantity) => quantity.id(),
        PooledNumber::BlockNoise => "noise_4x4",
        _ => "width_ratio",
    }
}

impl Margins {
    /// The first name that is no gated score, or number that is no margin, in words.
    pub fn problem(&self) -> Option<String> {
        let all = self.all.iter().chain(self.scenes.values().flatten());
        all.into_iter().find_map(|(name, margin)| {
            if !gated().any(|(id, _)| id == name) {
                let known: Vec<&str> = gated().map(|(id, _)| id).collect();
                return Some(format!("no score \"{name}\" is gated; there are {}", known.join(", ")));
            }
            let legal = |v: f64| v.is_finite() && v >= 0.0;
            (!legal(margin.absolute) || !legal(margin.relative))
                .then(|| format!("the margin of {name} must be numbers from 0"))
        })
    }

    /// Of a score over windows of these scenes: the mean of their own.
    pub(super) fn mean<'a>(&self, scenes: impl Iterator<Item = &'a str>, number: PooledNumber) -> Margin {
        let each: Vec<Margin> = scenes.map(|scene| self.of(scene, number)).collect();
        let mean = |part: fn(&Margin) -> f64| each.iter().map(part).sum::<f64>() / each.len().max(1) as f64;
        Margin { absolute: mean(|m| m.absolute), relative: mean(|m| m.relative) }
    }

    /// What others than these say, in words.
    pub(super) fn changes(&self, now: &Self) -> Vec<String> {
        let scenes: BTreeSet<&str> =
            self.scenes.keys().chain(now.scenes.keys()).map(String::as_str).chain([""]).collect();
        let mut changes = Vec::new();
        for (scene, (name, number)) in scenes.iter().flat_map(|s| gated().map(move |g| (s, g))) {
            let (before, after) = (self.of(scene, number), now.of(scene, number));
            if before != after {
                let place = if scene.is_empty() { String::new() } else { format!(" in {scene}") };
                changes.push(format!(
                    "{name}{place}: {} in the baseline, {} now",
                    words(before),
                    words(after)
                ));
            }
        }
        changes
    }

    /// Of a score in a scene.
    pub(super) fn of(&self, scene: &str, number: PooledNumber) -> Margin {
        let own = self.scenes.get(scene).and_then(|m| m.get(id(number)));
        match own.or_else(|| self.all.get(id(number))) {
            Some(card) => Margin { absolute: card.absolute, relative: card.relative },
            None => Margin::usual(number),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use umbrage_metrics::Quantity;

    #[test]
    fn over_windows_margins_are_the_mean_of_their_own() {
        let error = PooledNumber::Cell(Quantity::Error);
        let card = |absolute| BTreeMap::from([("error".to_string(), MarginCard { absolute, relative: 0.0 })]);
        let margins = Margins { all: card(1.0), scenes: BTreeMap::from([("a".to_string(), card(4.0))]) };
        // Two windows of "a", one of "b": (4 + 4 + 1) / 3.
        let mean = margins.mean(["a", "a", "b"].into_iter(), error);
        assert_eq!(mean, Margin { absolute: 3.0, relative: 0.0 });
        assert_eq!(margins.changes(&margins), [""; 0]);
        let said = margins.changes(&Margins { all: card(1.0), ..Margins::default() });
        assert_eq!(said, ["error in a: 4.00 or 0 % in the baseline, 1.00 or 0 % now"]);
    }
}
