//! What has to be measured for some claims, each thing once.

use super::place::Place;
use super::registry::{COSTS, Claim, Part, Registry};
use super::subject::{Comparison, full_name};
use crate::error::CliError;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use umbrage_metrics::{PooledNumber, SumKind};
use umbrage_shadows::{Calibration, PROBES, VARIANTS};

/// A way to measure a variant in a window.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Measure {
    /// Patterns drawn afresh: cells, profile, blocks, widths, and a picture.
    Scores,
    /// One pattern frozen to the screen.
    Frozen,
    /// Patterns drawn afresh, read at the nearest pixel of whole frames.
    Pixels,
    /// One pattern frozen to the screen, read so.
    FrozenPixels,
    /// Beside another variant, by its full name.
    Against(String),
    /// The plain values, of a probe.
    Values,
}

/// Variants by place, with the ways in which each is measured.
pub(crate) type Needs = BTreeMap<Place, BTreeMap<String, BTreeSet<Measure>>>;

impl Measure {
    /// Whether it needs the truth of each frame's own pixels.
    pub(crate) fn reads_pixels(&self) -> bool {
        matches!(self, Self::Pixels | Self::FrozenPixels)
    }

    /// What a part's number is made from.
    pub(crate) fn of(number: PooledNumber, part: &Part) -> Self {
        match number.kind() {
            SumKind::Frozen => Self::Frozen,
            SumKind::Pixels => Self::Pixels,
            SumKind::FrozenPixels => Self::FrozenPixels,
            SumKind::Against => Self::Against(full_name(part.against.as_deref().unwrap_or("hard"))),
            SumKind::Values => Self::Values,
            _ => Self::Scores,
        }
    }
}

/// All that these claims need of pictures.
pub(crate) fn needs(claims: &[&Claim], registry: &Registry) -> Result<Needs, CliError> {
    let mut needs = Needs::new();
    each_comparison(claims, registry, |part, comparison| {
        let Some(number) = PooledNumber::named(&part.number) else { return };
        for (place, variant) in comparison.units() {
            let measures = needs.entry(place.clone()).or_default().entry(variant.to_string()).or_default();
            let measure = Measure::of(number, part);
            // Scores bring the picture for the crop; what a probe counts is no picture.
            let picture = (measure != Measure::Values).then_some(Measure::Scores);
            measures.extend(picture.into_iter().chain([measure]));
        }
    })?;
    Ok(needs)
}

/// All that these claims, and the table of times, need of a GPU's clock.
pub(crate) fn cost_needs(
    claims: &[&Claim],
    registry: &Registry,
) -> Result<BTreeMap<Place, BTreeSet<String>>, CliError> {
    let mut needs: BTreeMap<Place, BTreeSet<String>> = BTreeMap::new();
    each_comparison(claims, registry, |part, comparison| {
        if COSTS.contains(&part.number.as_str()) {
            for (place, variant) in comparison.units() {
                needs.entry(place.clone()).or_default().insert(variant.to_string());
            }
        }
    })?;
    // The table of times, and with it every technique, is timed in the scene as it is: the first place.
    if let Some((place, names)) = needs.iter_mut().next() {
        names.extend(registry.time.iter().map(|row| full_name(&row.ours)));
        let light = place.build()?.lights[0];
        let all = VARIANTS.iter().chain(PROBES).filter(|v| v.technique.lights().contain(&light));
        names.extend(all.flat_map(|v| Calibration::ALL.map(|c| format!("{}/{}", v.name, c.name()))));
    }
    Ok(needs)
}

fn each_comparison(
    claims: &[&Claim],
    registry: &Registry,
    mut then: impl FnMut(&Part, &Comparison),
) -> Result<(), CliError> {
    for claim in claims {
        for part in &claim.part {
            let wrong = |message| CliError::Suite {
                path: Path::new("claims").into(),
                message: format!("{}, \"{}\": {message}", claim.id, part.says),
            };
            if let Some(comparison) = Comparison::of(part, registry).map_err(wrong)? {
                then(part, &comparison);
            }
        }
    }
    Ok(())
}
