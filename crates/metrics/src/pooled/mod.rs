//! Numbers that are pooled from sums per tile, by name: what claims compare.
//!
//! A window of a variant is reduced once to a few [`SumTable`]s; every number, its interval and every
//! comparison follow from them. Blind spots are those of the numbers (registry) and of docs/claims.md.

mod against;
mod blocks;
mod joint;
mod widths;

pub use against::{against_sums, value_sums};
pub use blocks::block_sums;
pub use joint::{Member, compare_jointly};
pub use widths::{true_widths, width_sums};

use crate::profile::{PROFILE_SUMS, profile_values, seen_classes};
use crate::quantity::sums;
use crate::{ProfileTable, Quantity, TileTable};
use serde::{Deserialize, Serialize};

/// Sums of one window, tile by tile (column, row, sums).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SumTable {
    /// In the tiling's order; every row has the same number of sums.
    pub rows: Vec<(u32, u32, Vec<f64>)>,
}

/// Which sums a number is made from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SumKind {
    /// The cells: [`TileTable::sum_table`] of patterns drawn afresh.
    Cells,
    /// The same of one pattern frozen to the screen.
    Frozen,
    /// The cells of the pixel reading: each point as the nearest pixel of a whole frame shows it.
    Pixels,
    /// The same of one pattern frozen to the screen.
    FrozenPixels,
    /// The shape of the penumbra: [`ProfileTable::sum_table`].
    Profile,
    /// Means over 4x4 px: [`block_sums`].
    Blocks,
    /// Radii and widths on the surface: [`width_sums`].
    Widths,
    /// Two variants at the same points: [`against_sums`].
    Against,
    /// The plain values: [`value_sums`].
    Values,
}

/// A number by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PooledNumber {
    /// One of the scorecard's quantities.
    Cell(Quantity),
    /// The same of the pixel reading: its SWIMMING includes the crawl of edges over pixels.
    InPixels(Quantity),
    /// SWIMMING of a frozen pattern: the variance over time at a fixed surface point.
    Flicker,
    /// The same of the pixel reading.
    FlickerInPixels,
    /// 10-90 % width over the true one.
    WidthRatio,
    /// Its spread over the direction of the edge.
    WidthAnisotropy,
    /// Equal steps of the profile.
    EffectiveLevels,
    /// Share of the profile that is flat although the truth rises.
    PlateauFraction,
    /// ERROR of means over 4x4 px.
    BlockError,
    /// NOISE of means over 4x4 px: its low frequencies.
    BlockNoise,
    /// Mean of variant minus truth in the penumbra.
    SignedError,
    /// Exponent of the measured width over the true one: 0 = constant, 1 = right.
    WidthGrowth,
    /// Correlation of the noise with the local change of the true radius.
    NoiseMeetsChange,
    /// Correlation of SWIMMING with the local change of the true radius.
    SwimMeetsChange,
    /// Root mean square difference from another variant, over all counted points.
    Departure,
    /// Share of values whose bits differ from another variant's.
    Differing,
    /// Mean value over all counted points: what a probe counts.
    MeanValue,
}

/// The numbers that are no [`Quantity`], with their names.
const NAMED: [(&str, PooledNumber); 18] = [
    ("error_in_pixels", PooledNumber::InPixels(Quantity::Error)),
    ("swimming_in_pixels", PooledNumber::InPixels(Quantity::Swimming)),
    ("noise_in_pixels", PooledNumber::InPixels(Quantity::Noise)),
    ("flicker_in_pixels", PooledNumber::FlickerInPixels),
    ("flicker", PooledNumber::Flicker),
    ("width_ratio", PooledNumber::WidthRatio),
    ("width_anisotropy", PooledNumber::WidthAnisotropy),
    ("effective_levels", PooledNumber::EffectiveLevels),
    ("plateau_fraction", PooledNumber::PlateauFraction),
    ("error_4x4", PooledNumber::BlockError),
    ("noise_4x4", PooledNumber::BlockNoise),
    ("signed_error", PooledNumber::SignedError),
    ("width_growth", PooledNumber::WidthGrowth),
    ("noise_meets_change", PooledNumber::NoiseMeetsChange),
    ("swim_meets_change", PooledNumber::SwimMeetsChange),
    ("departure", PooledNumber::Departure),
    ("differing", PooledNumber::Differing),
    ("mean_value", PooledNumber::MeanValue),
];

impl PooledNumber {
    /// By the name that claims use.
    pub fn named(name: &str) -> Option<Self> {
        let quantity = Quantity::ALL.into_iter().find(|q| q.id() == name).map(Self::Cell);
        quantity.or_else(|| NAMED.iter().find(|(n, _)| *n == name).map(|(_, number)| *number))
    }

    /// Every name.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Quantity::ALL.into_iter().map(Quantity::id).chain(NAMED.iter().map(|(name, _)| *name))
    }

    /// The sums that it is made from.
    pub fn kind(self) -> SumKind {
        match self {
            Self::Cell(_) => SumKind::Cells,
            Self::InPixels(_) => SumKind::Pixels,
            Self::Flicker => SumKind::Frozen,
            Self::FlickerInPixels => SumKind::FrozenPixels,
            Self::WidthRatio | Self::WidthAnisotropy | Self::EffectiveLevels | Self::PlateauFraction => {
                SumKind::Profile
            }
            Self::BlockError | Self::BlockNoise => SumKind::Blocks,
            Self::SignedError | Self::WidthGrowth | Self::NoiseMeetsChange | Self::SwimMeetsChange => {
                SumKind::Widths
            }
            Self::Departure | Self::Differing => SumKind::Against,
            Self::MeanValue => SumKind::Values,
        }
    }

    /// Whether a cluster with these sums says anything about this number.
    fn is_seen(self, sums: &[f64]) -> bool {
        let any = |slots: &[usize]| slots.iter().any(|&s| sums[s] > 0.0);
        match self {
            Self::Cell(quantity) | Self::InPixels(quantity) => any(quantity.seen_by()),
            Self::Flicker | Self::FlickerInPixels => any(Quantity::Swimming.seen_by()),
            _ if self.kind() == SumKind::Profile => any(&PROFILE_SUMS),
            Self::BlockError | Self::BlockNoise => any(&[blocks::COUNT]),
            Self::SignedError => any(&[widths::POINTS]),
            Self::WidthGrowth => any(&[widths::GROWTH]),
            Self::NoiseMeetsChange => any(&[widths::NOISE]),
            Self::SwimMeetsChange => any(&[widths::SWIM]),
            _ => any(&[against::POINTS]),
        }
    }

    /// The number that is linear in the sums: MSE for ERROR, otherwise itself.
    pub(crate) fn squared(self) -> Self {
        if self == Self::Cell(Quantity::Error) { Self::Cell(Quantity::Mse) } else { self }
    }

    /// How much each window counts in the number of all (they add up to 1).
    pub(crate) fn weights(self, windows: &[&SumTable]) -> Vec<f64> {
        let slot = match self {
            Self::Cell(quantity @ (Quantity::LightLeak | Quantity::FalseShadow)) => quantity.seen_by()[0],
            Self::WidthRatio => PROFILE_SUMS[0],
            _ => return vec![1.0 / windows.len().max(1) as f64; windows.len()],
        };
        let points: Vec<f64> = windows.iter().map(|t| t.rows.iter().map(|(.., s)| s[slot]).sum()).collect();
        let total: f64 = points.iter().sum();
        points.iter().map(|p| p / total).collect()
    }

    /// The number of some windows; none where they do not say.
    pub fn of(self, windows: &[&SumTable]) -> Option<f64> {
        let seen: Vec<&SumTable> = windows.iter().copied().filter(|t| self.is_seen_in(t)).collect();
        let sum = |table: &&SumTable| {
            let width = table.rows.first().map_or(0, |(.., s)| s.len());
            table.rows.iter().fold(vec![0.0; width], |mut total, (.., sums)| {
                add(&mut total, 0, sums);
                total
            })
        };
        let sums: Vec<Vec<f64>> = seen.iter().map(sum).collect();
        let value = self.value(&sums, &self.classes(&seen));
        (!sums.is_empty() && value.is_finite()).then_some(value)
    }

    /// Whether a window says anything about this number.
    pub(crate) fn is_seen_in(self, table: &SumTable) -> bool {
        table.rows.iter().any(|(.., sums)| self.is_seen(sums))
    }

    /// The number of these windows' sums; NaN where they do not say.
    fn value(self, windows: &[Vec<f64>], seen: &[usize]) -> f64 {
        let mean = |of: &dyn Fn(&[f64]) -> f64| {
            let values: Vec<f64> = windows.iter().map(|w| of(w)).filter(|v| v.is_finite()).collect();
            values.iter().sum::<f64>() / values.len() as f64
        };
        match self {
            Self::Cell(quantity) | Self::InPixels(quantity) => quantity.value(windows),
            Self::Flicker | Self::FlickerInPixels => Quantity::Swimming.value(windows),
            Self::WidthRatio => profile_values(windows, seen)[0],
            Self::WidthAnisotropy => profile_values(windows, seen)[1],
            Self::EffectiveLevels => profile_values(windows, seen)[2],
            Self::PlateauFraction => profile_values(windows, seen)[4],
            Self::BlockError => mean(&blocks::squared).max(0.0).sqrt(),
            Self::BlockNoise => mean(&blocks::noise),
            Self::SignedError => mean(&widths::signed),
            Self::WidthGrowth => widths::growth(windows),
            Self::NoiseMeetsChange => widths::correlation(windows, widths::NOISE),
            Self::SwimMeetsChange => widths::correlation(windows, widths::SWIM),
            Self::Departure => mean(&against::squared).sqrt(),
            Self::Differing => mean(&against::differing),
            Self::MeanValue => mean(&against::value),
        }
    }

    /// What has to be known of all tables before any is resampled: the classes of edge direction.
    fn classes(self, tables: &[&SumTable]) -> Vec<usize> {
        match self.kind() {
            SumKind::Profile => seen_classes(tables.iter().flat_map(|t| &t.rows)),
            _ => Vec::new(),
        }
    }
}

impl TileTable {
    /// The sums from which every [`Quantity`] follows.
    pub fn sum_table(&self) -> SumTable {
        SumTable { rows: self.tiles.iter().map(|t| (t.column, t.row, sums(t))).collect() }
    }
}

impl ProfileTable {
    /// The sums from which the shape of the penumbra follows.
    pub fn sum_table(&self) -> SumTable {
        SumTable { rows: self.rows().to_vec() }
    }
}

impl SumTable {
    /// The sums of squares of `side` x `side` tiles, in row order: what intervals are drawn over, and all
    /// that a comparison needs. Resample the result with clusters of one tile.
    pub fn clustered(&self, side: u32) -> Self {
        let side = side.max(1);
        let mut clusters: std::collections::BTreeMap<(u32, u32), Vec<f64>> = Default::default();
        for (column, row, sums) in &self.rows {
            let cluster =
                clusters.entry((row / side, column / side)).or_insert_with(|| vec![0.0; sums.len()]);
            cluster.iter_mut().zip(sums).for_each(|(c, s)| *c += s);
        }
        Self { rows: clusters.into_iter().map(|((row, column), sums)| (column, row, sums)).collect() }
    }
}

/// Adds to a row of sums.
fn add(sums: &mut [f64], at: usize, values: &[f64]) {
    sums[at..at + values.len()].iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_number_has_one_name_and_is_found_by_it() {
        let names: Vec<&str> = PooledNumber::names().collect();
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len());
        let numbers: BTreeSet<_> = names.iter().map(|n| PooledNumber::named(n).expect("known")).collect();
        assert_eq!(numbers.len(), names.len());
        assert_eq!(PooledNumber::named("beauty"), None);
    }
}
