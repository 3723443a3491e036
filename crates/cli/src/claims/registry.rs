//! The registry: claims as data, read from TOML and checked before anything is measured.

use super::exact;
use super::rule::Relation;
use crate::error::CliError;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use umbrage_metrics::PooledNumber;

/// The claims of the five documents, compiled in.
const BUILT_IN: &str = include_str!("claims.toml");

/// A file of claims.
#[derive(Deserialize, Clone, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct Registry {
    /// Names for lists of places.
    #[serde(default)]
    pub(crate) places: BTreeMap<String, Vec<String>>,
    /// Margins by number.
    pub(crate) margin: BTreeMap<String, Margins>,
    /// In display order.
    pub(crate) claim: Vec<Claim>,
    /// A document's table of times, to stand beside ours.
    #[serde(default)]
    pub(crate) time: Vec<TimeRow>,
}

/// What matters of a number, unless a part says otherwise.
#[derive(Deserialize, Clone, Copy, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct Margins {
    /// Of A / B - 1; a number without one is compared by difference.
    pub(crate) ratio: Option<f64>,
    /// Of A - B.
    pub(crate) absolute: Option<f64>,
}

/// A claim.
#[derive(Deserialize, Clone, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct Claim {
    pub(crate) id: String,
    pub(crate) document: String,
    pub(crate) statement: String,
    /// How it was measured, where that needs a word.
    pub(crate) note: Option<String>,
    pub(crate) part: Vec<Part>,
}

/// A comparison.
#[derive(Deserialize, Clone, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct Part {
    pub(crate) says: String,
    /// A pooled number, `cost`, `cost_with_maps` or an exact number.
    pub(crate) number: String,
    /// None for an exact number.
    pub(crate) a: Option<Subject>,
    /// A subject or a constant.
    pub(crate) b: Other,
    /// Names of places or of lists of them: `edge-ladder/P1`, `general`.
    #[serde(default)]
    pub(crate) places: Vec<String>,
    /// Applied to both subjects.
    #[serde(default)]
    pub(crate) at: Overrides,
    pub(crate) expect: Relation,
    pub(crate) margin: Option<f64>,
    /// Of the margin, where it is not the number's own.
    pub(crate) why: Option<String>,
    /// The ratio that is expected, where it is not 1.
    pub(crate) target: Option<f64>,
    /// A third subject from which both are measured.
    pub(crate) from: Option<Subject>,
    /// Subjects by which A and B are divided first.
    pub(crate) per: Option<[Subject; 2]>,
    /// The variant that a departure is one from.
    pub(crate) against: Option<String>,
}

/// What is compared with A.
#[derive(Deserialize, Clone, Debug)]
#[serde(untagged)]
pub(crate) enum Other {
    Constant(f64),
    Subject(Subject),
}

/// A variant at the part's places, or several of them made into one number.
#[derive(Deserialize, Clone, Debug)]
#[serde(untagged)]
pub(crate) enum Subject {
    Name(String),
    Full(Box<FullSubject>),
}

/// A subject with everything that it may say.
#[derive(Deserialize, Clone, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct FullSubject {
    pub(crate) variant: Option<String>,
    /// Several variants, of which `take` makes one number.
    #[serde(default)]
    pub(crate) variants: Vec<String>,
    /// In place of the part's.
    pub(crate) places: Option<Vec<String>>,
    #[serde(default)]
    pub(crate) at: Overrides,
    /// The same variant at several settings, of which `take` makes one number.
    #[serde(default)]
    pub(crate) each: Vec<Overrides>,
    #[serde(default)]
    pub(crate) take: Take,
}

/// How several members become one number.
#[derive(Deserialize, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Take {
    /// There is one.
    #[default]
    Only,
    Least,
    /// Largest less smallest, in each place; then the mean over places.
    Spread,
}

/// What differs from the scene's own settings.
#[derive(Deserialize, Clone, Debug, Default, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Overrides {
    pub(crate) path: Option<String>,
    /// Side of the shadow map in texels.
    pub(crate) map: Option<u32>,
    /// Angular diameter of the sun.
    pub(crate) sun_degrees: Option<f64>,
    /// Radius of a light that has a place, metres.
    pub(crate) light_radius: Option<f64>,
    /// Side of the square that the map covers, metres.
    pub(crate) region_width: Option<f64>,
}

/// A row of a document's table of times.
#[derive(Deserialize, Clone, Debug)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimeRow {
    pub(crate) what: String,
    pub(crate) document_ms: f64,
    /// Our variant.
    pub(crate) ours: String,
    /// Only passes whose label starts with this; all otherwise.
    pub(crate) passes: Option<String>,
    /// All but passes whose label starts with this.
    pub(crate) without: Option<String>,
}

/// Numbers that come from a GPU's clock.
pub(crate) const COSTS: [&str; 2] = ["cost", "cost_with_maps"];

impl Registry {
    /// The compiled-in claims.
    pub(crate) fn built_in() -> Result<Self, CliError> {
        Self::parse(BUILT_IN, Path::new("claims.toml"))
    }

    /// Claims of a file.
    pub(crate) fn read(path: &Path) -> Result<Self, CliError> {
        Self::parse(&std::fs::read_to_string(path).map_err(CliError::file(path))?, path)
    }

    fn parse(text: &str, path: &Path) -> Result<Self, CliError> {
        let wrong = |message: String| CliError::Suite { path: path.into(), message };
        let registry: Self = toml::from_str(text).map_err(|e| wrong(e.to_string()))?;
        for claim in &registry.claim {
            for part in &claim.part {
                registry.check(part).map_err(|m| wrong(format!("{}, \"{}\": {m}", claim.id, part.says)))?;
            }
        }
        Ok(registry)
    }

    fn check(&self, part: &Part) -> Result<(), String> {
        let number = part.number.as_str();
        let is_exact = exact::NAMES.contains(&number);
        if !is_exact && !COSTS.contains(&number) && PooledNumber::named(number).is_none() {
            return Err(format!("there is no number \"{number}\""));
        }
        if part.a.is_some() == is_exact {
            return Err("exact numbers have no subject, all others have one".into());
        }
        if !is_exact && self.places_of(&part.places)?.is_empty() {
            return Err("no places".into());
        }
        if part.margin.is_none() && !self.margin.contains_key(number) {
            return Err(format!("neither the part nor \"{number}\" has a margin"));
        }
        match part.margin {
            Some(margin) if !(margin.is_finite() && margin >= 0.0) => Err("a margin is at least 0".into()),
            _ => Ok(()),
        }
    }

    /// The claims with these ids, in display order; all without ids.
    pub(crate) fn select(&self, ids: &[String]) -> Result<Vec<&Claim>, CliError> {
        let known = |id: &String| self.claim.iter().any(|c| c.id.eq_ignore_ascii_case(id));
        if let Some(unknown) = ids.iter().find(|id| !known(id)) {
            let names: Vec<&str> = self.claim.iter().map(|c| c.id.as_str()).collect();
            return Err(CliError::Usage(format!(
                "unknown claim \"{unknown}\"; there are {}",
                names.join(", ")
            )));
        }
        let wanted = |c: &&Claim| ids.is_empty() || ids.iter().any(|id| c.id.eq_ignore_ascii_case(id));
        Ok(self.claim.iter().filter(wanted).collect())
    }

    /// Scenes and paths of places and lists of places.
    pub(crate) fn places_of(&self, names: &[String]) -> Result<Vec<(String, String)>, String> {
        let mut found = Vec::new();
        for name in names {
            let list = self.places.get(name).cloned().unwrap_or_else(|| vec![name.clone()]);
            for place in list {
                let (scene, path) = place
                    .split_once('/')
                    .ok_or(format!("\"{place}\" is no scene/path and no list of places"))?;
                found.push((scene.to_string(), path.to_string()));
            }
        }
        Ok(found)
    }
}

#[cfg(test)]
mod tests;
