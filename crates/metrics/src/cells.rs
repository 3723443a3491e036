//! The five cells and what is made from the same sums.
//!
//! | | static | moving |
//! | --- | --- | --- |
//! | smooth | wrong width, over- and under-darkening | breathing penumbra |
//! | structured | bands, aliasing | crawling bands, texel swim |
//! | noise | one cell | |
//!
//! Source: METRICS sections 1 and 2. Range: each cell 0 to 1, small negative values are legal
//! (the estimators are unbiased and not clamped). Direction: lower is better. Blind spot: only T
//! frames of one path at one speed; equal T, path and speed compare. For T = 1 the moving cells are
//! not measured, and BANDING is its static cell.

use crate::quantity::stratum;
use crate::{Bootstrap, Measurement, MetricsError, Missing, Quantity, TileTable};
use serde::{Deserialize, Serialize};

/// Every quantity of one or more windows, with its interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cells {
    /// One entry for each of [`Quantity::ALL`], in that order.
    scores: Vec<(Quantity, Measurement)>,
}

impl Cells {
    /// One quantity.
    pub fn get(&self, quantity: Quantity) -> Measurement {
        let found = self.scores.iter().find(|(q, _)| *q == quantity);
        found.map_or(Measurement::NotMeasured(Missing::NoPenumbra), |(_, measurement)| *measurement)
    }

    /// All, in display order.
    pub fn iter(&self) -> impl Iterator<Item = (Quantity, Measurement)> {
        self.scores.iter().copied()
    }
}

/// Pools windows (the mean of each window's value; leaks, false shadow and the outside share over all
/// points) and puts intervals on everything; tiles are
/// resampled within each window.
///
/// # Errors
/// No table, or tables of different T, S or tile side: such scores do not compare.
pub fn cells(tables: &[&TileTable], bootstrap: &Bootstrap) -> Result<Cells, MetricsError> {
    check_alike(tables)?;
    let strata: Vec<_> = tables.iter().map(|t| stratum(t, bootstrap.cluster_tiles)).collect();
    let mut scores: Vec<(Quantity, Measurement)> = Vec::with_capacity(Quantity::ALL.len());
    for first in [Quantity::Mse, Quantity::LightLeak, Quantity::FalseShadow, Quantity::OutsideShare] {
        let seen = first.seen_by();
        let group: Vec<Quantity> = Quantity::ALL.into_iter().filter(|q| q.seen_by() == seen).collect();
        let clusters: Vec<_> = strata.iter().map(|s| s.clone().where_any(seen)).collect();
        let estimates = bootstrap.estimate(&clusters, |sums| group.iter().map(|q| q.value(sums)).collect());
        scores.extend(group.iter().zip(estimates).map(|(&quantity, estimate)| {
            let undefined = (!estimate.score.value.is_finite()).then_some(Missing::NoError);
            let missing = quantity.missing(tables).or(undefined).map(Measurement::NotMeasured);
            (quantity, missing.unwrap_or(Measurement::Measured(estimate.score)))
        }));
    }
    scores.sort_by_key(|(quantity, _)| *quantity);
    let mut cells = Cells { scores };
    cells.hide_unresolved_rhythm();
    Ok(cells)
}

impl Cells {
    /// The von Neumann ratio divides by SWIMMING: it means nothing unless that is resolved above 0.
    fn hide_unresolved_rhythm(&mut self) {
        let swims = self.get(Quantity::Swimming).score();
        if swims.is_some_and(|s| s.low <= 0.0) {
            let rhythm = self.scores.iter_mut().filter(|(q, _)| *q == Quantity::VonNeumann);
            rhythm.for_each(|(_, m)| *m = Measurement::NotMeasured(Missing::NothingSwims));
        }
    }
}

/// That tables are windows of one kind.
pub(crate) fn check_alike(tables: &[&TileTable]) -> Result<(), MetricsError> {
    let Some(first) = tables.first() else { return Err(MetricsError::Zero("the number of windows")) };
    if tables.iter().any(|t| t.frames != first.frames) {
        return Err(MetricsError::Unlike("windows of different numbers of frames"));
    }
    if tables.iter().any(|t| t.tile_px != first.tile_px) {
        return Err(MetricsError::Unlike("tiles of different sizes"));
    }
    Ok(())
}
