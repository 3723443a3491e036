//! What is too small to matter: the `[gate]` table of a suite.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
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

    /// Of a score in a scene.
    pub(super) fn of(&self, scene: Option<&str>, number: PooledNumber) -> Margin {
        let own = scene.and_then(|s| self.scenes.get(s)).and_then(|m| m.get(id(number)));
        match own.or_else(|| self.all.get(id(number))) {
            Some(card) => Margin { absolute: card.absolute, relative: card.relative },
            None => Margin::usual(number),
        }
    }
}
