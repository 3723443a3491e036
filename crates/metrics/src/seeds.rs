//! How much a number varies from run to run: the spread over pattern seeds.
//!
//! The jackknife over seeds (Tukey 1958; Efron and Stein 1981), cluster by cluster of tiles, because patterns are
//! drawn afresh for each 16x16 block: clusters are independent, so their variances add and so do their
//! degrees of freedom (Satterthwaite 1946). Leaving a seed out recomputes the unbiased cells, so
//! noise does not shrink as it does when seeds are resampled. Blind spot: patterns larger than a cluster.

use crate::gate::{GATED, Reading};
use crate::pooled::SumKind;
use crate::{Bootstrap, MetricsError, Panel, PanelTruth, PooledNumber, SumTable, Tiling};
use crate::{block_sums, window_profiles, window_tiles};
use serde::{Deserialize, Serialize};
use umbrage_frame::Anchors;

/// Fewest seeds that leave two behind when one is left out.
const FEWEST: usize = 3;

/// Variance of a number of one window over seeds, and its degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedSpread {
    /// Of the number; of ERROR, of its square (MSE).
    pub variance: f64,
    /// Degrees of freedom of the variance; 0 where there is none.
    pub freedom: f64,
}

/// The spread of each of [`GATED`] in one window; `None` where the number is not defined. `Ok(None)` with two
/// seeds: one left alone has no noise to compare. Without randomness all spreads are 0.
///
/// # Errors
/// As [`window_tiles`].
pub fn seed_spread(
    panel: &Panel,
    truth: &PanelTruth,
    anchors: &Anchors,
    tiling: &Tiling,
) -> Result<Option<Vec<Option<SeedSpread>>>, MetricsError> {
    if panel.seeds == 1 {
        let none = Some(SeedSpread { variance: 0.0, freedom: 0.0 });
        return Ok(Some(vec![none; GATED.len()]));
    }
    if panel.seeds < FEWEST {
        return Ok(None);
    }
    let side = Bootstrap::default().cluster_tiles;
    let tables = |panel: &Panel| -> Result<[SumTable; 3], MetricsError> {
        let cells = window_tiles(panel, truth, tiling)?.sum_table();
        let profile = window_profiles(panel, truth, anchors, tiling)?.sum_table();
        let blocks = block_sums(panel, truth, tiling)?;
        Ok([cells, profile, blocks].map(|table| table.clustered(side)))
    };
    let all = tables(panel)?;
    let without: Vec<[SumTable; 3]> =
        (0..panel.seeds).map(|seed| tables(&panel.without(seed))).collect::<Result<_, _>>()?;
    Ok(Some(GATED.iter().map(|&number| spread(number, &all, &without)).collect()))
}

/// A number of several windows with its spread over seeds; `None` where no window has it.
pub fn pooled_reading(number: PooledNumber, windows: &[(&SumTable, Option<SeedSpread>)]) -> Option<Reading> {
    let seen: Vec<_> = windows.iter().filter(|(table, _)| number.is_seen_in(table)).collect();
    let tables: Vec<&SumTable> = seen.iter().map(|w| w.0).collect();
    let value = number.of(&tables)?;
    let (mut variance, mut squares) = (0.0, 0.0);
    for ((_, spread), weight) in seen.iter().zip(number.weights(&tables)) {
        // A window without a number of its own (no rise across any penumbra) adds none.
        let Some(spread) = spread else { continue };
        let part = weight * weight * spread.variance;
        variance += part;
        squares += if part > 0.0 { part * part / spread.freedom } else { 0.0 };
    }
    let freedom = if squares > 0.0 { variance * variance / squares } else { 0.0 };
    // Of a root: the derivative is 1 / (2 root).
    if number.squared() != number {
        variance = if value > 0.0 { variance / (4.0 * value * value) } else { variance.sqrt() };
    }
    Some(Reading { value, variance, freedom })
}

/// Which of the three tables a gated number is made from: cells, profile, blocks.
pub fn gate_table(number: PooledNumber) -> usize {
    match number.kind() {
        SumKind::Profile => 1,
        SumKind::Blocks => 2,
        _ => 0,
    }
}

fn spread(number: PooledNumber, all: &[SumTable; 3], without: &[[SumTable; 3]]) -> Option<SeedSpread> {
    // The root of a sum is as good as linear in no single cluster; its square is linear.
    let number = number.squared();
    let kind = gate_table(number);
    let table = &all[kind];
    let whole = number.of(&[table])?;
    let s = without.len() as f64;
    let (mut variance, mut squares) = (0.0, 0.0);
    let mut changed = table.clone();
    for cluster in 0..table.rows.len() {
        // What the number would be if this cluster had been measured with one seed fewer.
        let mut one = |k: usize| {
            changed.rows[cluster].2.clone_from(&without[k][kind].rows[cluster].2);
            number.of(&[&changed]).unwrap_or(whole) - whole
        };
        let shifts: Vec<f64> = (0..without.len()).map(&mut one).collect();
        changed.rows[cluster].2.clone_from(&table.rows[cluster].2);
        let mean = shifts.iter().sum::<f64>() / s;
        let own = (s - 1.0) / s * shifts.iter().map(|d| (d - mean).powi(2)).sum::<f64>();
        variance += own;
        squares += own * own / (s - 1.0);
    }
    let freedom = if squares > 0.0 { variance * variance / squares } else { 0.0 };
    Some(SeedSpread { variance, freedom })
}

impl Panel {
    /// The same without one seed.
    fn without(&self, seed: usize) -> Self {
        let kept = self.values.chunks(self.points.max(1)).enumerate().filter(|(i, _)| i % self.seeds != seed);
        let values = kept.flat_map(|(_, values)| values.iter().copied()).collect();
        Self { seeds: self.seeds - 1, values, ..*self }
    }
}
