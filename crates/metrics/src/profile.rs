//! The shape of a penumbra: its width against the true one, over the direction of the edge, and
//! whether it is a staircase. Works on scattered anchors: no edge is traced.
//!
//! Source: METRICS section 3; the width ratio follows the coarea formula (area = width x length of
//! edge, and both shadows have the same edge). Ranges, directions and blind spots: see the registry
//! entries `width_ratio`, `width_anisotropy`, `effective_levels`, `plateau_fraction`. The main ones:
//! grey leaks beside a penumbra count as width; a profile cannot show more levels than it has bins.

use crate::bootstrap::Stratum;
use crate::edges::{CLASSES, EdgeClasses};
use crate::staircase::{STAIRS, SeedMeans, stairs};
use crate::tiles::check;
use crate::{Bootstrap, Measurement, MetricsError, Missing, Panel, PanelTruth, Score, Tiling};
use rayon::prelude::*;
use umbrage_frame::Anchors;

/// The 10-90 % width: visibilities between these count.
const WIDTH: (f64, f64) = (0.1, 0.9);

/// Smallest share of the true penumbra area that a class of edge direction must hold to count.
const CLASS_SHARE: f64 = 0.05;

// Places in the vector of sums: areas, areas per class, then the sums of `staircase`.
const TRUE_AREA: usize = 0;
const AREA: usize = 1;
const TRUE_CLASS: usize = 2;
const CLASS: usize = TRUE_CLASS + CLASSES;
const STAIR: usize = CLASS + CLASSES;
/// The sums of which a cluster must have one to say anything.
pub(crate) const PROFILE_SUMS: [usize; 3] = [TRUE_AREA, AREA, STAIR];

/// Sums per tile from which [`profiles`] are made.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileTable {
    rows: Vec<(u32, u32, Vec<f64>)>,
}

impl ProfileTable {
    /// Column, row and sums of each tile.
    pub(crate) fn rows(&self) -> &[(u32, u32, Vec<f64>)] {
        &self.rows
    }
}

/// What the penumbra of a variant looks like, over all windows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profiles {
    /// Measured 10-90 % width over the true one; 1 is right.
    pub width_ratio: Measurement,
    /// Largest minus smallest width ratio over the classes of edge direction.
    pub width_anisotropy: Measurement,
    /// Equal steps that the profile falls into.
    pub effective_levels: Measurement,
    /// What the truth itself scores in the same bins: no more levels can be told.
    pub resolvable_levels: Measurement,
    /// Share of the profile that is flat although the truth rises.
    pub plateau_fraction: Measurement,
}

/// Reduces one window of a variant to its profile sums.
///
/// # Errors
/// Inputs of different sizes, NaN at a counted point.
pub fn window_profiles(
    panel: &Panel,
    truth: &PanelTruth,
    anchors: &Anchors,
    tiling: &Tiling,
) -> Result<ProfileTable, MetricsError> {
    check(panel, truth, tiling)?;
    crate::error::expect_length("anchors", panel.points, anchors.len())?;
    let means = SeedMeans::new(panel, tiling)?;
    let classes = EdgeClasses::new(anchors, &truth.basis, tiling);
    let row = |(index, tile): (usize, &crate::Tile)| {
        let mut sums = vec![0.0; STAIR + STAIRS];
        if classes.near_penumbra[index] {
            let share = |of: &dyn Fn(u32) -> f64| {
                tile.points().filter(|&p| (WIDTH.0..WIDTH.1).contains(&of(p))).count() as f64
            };
            let areas = [share(&|p| f64::from(truth.basis[p as usize])), share(&|p| means.all(p))];
            (sums[TRUE_AREA], sums[AREA]) = (areas[0], areas[1]);
            if let Some(class) = classes.of_tile[index] {
                (sums[TRUE_CLASS + class], sums[CLASS + class]) = (areas[0], areas[1]);
            }
        }
        sums[STAIR..].copy_from_slice(&stairs(tile, truth, &means));
        (tile.column, tile.row, sums)
    };
    Ok(ProfileTable { rows: tiling.tiles.par_iter().enumerate().map(row).collect() })
}

/// Pools windows and puts intervals on the shape of the penumbra.
pub fn profiles(tables: &[&ProfileTable], bootstrap: &Bootstrap) -> Profiles {
    let strata: Vec<Stratum> = tables
        .iter()
        .map(|table| {
            let near = table.rows.iter().filter(|(.., s)| s[TRUE_AREA] + s[AREA] + s[STAIR] > 0.0);
            Stratum::new(STAIR + STAIRS, near.cloned(), bootstrap.cluster_tiles)
        })
        .collect();
    let seen = seen_classes(tables.iter().flat_map(|t| &t.rows));
    let estimates = bootstrap.estimate(&strata, |windows| profile_values(windows, &seen).to_vec());
    let measured = |index: usize, missing: Missing| {
        let score: Option<Score> = estimates.get(index).map(|e| e.score).filter(|s| s.value.is_finite());
        score.map_or(Measurement::NotMeasured(missing), Measurement::Measured)
    };
    Profiles {
        width_ratio: measured(0, Missing::NoPenumbra),
        width_anisotropy: measured(1, Missing::OneEdgeAngle),
        effective_levels: measured(2, Missing::NoProfile),
        resolvable_levels: measured(3, Missing::NoProfile),
        plateau_fraction: measured(4, Missing::NoProfile),
    }
}

/// Classes of edge direction with enough area to give a ratio.
pub(crate) fn seen_classes<'a>(rows: impl Iterator<Item = &'a (u32, u32, Vec<f64>)> + Clone) -> Vec<usize> {
    let sum = |slot: usize| rows.clone().map(|(.., s)| s[slot]).sum::<f64>();
    let total: f64 = (0..CLASSES).map(|class| sum(TRUE_CLASS + class)).sum();
    (0..CLASSES).filter(|class| total > 0.0 && sum(TRUE_CLASS + class) >= CLASS_SHARE * total).collect()
}

/// Ratios of sums over all windows, in the order of [`Profiles`]; NaN where there is nothing to divide by.
pub(crate) fn profile_values(windows: &[Vec<f64>], seen: &[usize]) -> [f64; 5] {
    let sum = |slot: usize| windows.iter().map(|w| w[slot]).sum::<f64>();
    let ratios = seen.iter().map(|class| sum(CLASS + class) / sum(TRUE_CLASS + class));
    let (low, high) = ratios.fold((f64::MAX, f64::MIN), |(low, high), r| (low.min(r), high.max(r)));
    let anisotropy = if seen.len() < 2 { f64::NAN } else { high - low };
    let stair = |slot: usize| sum(STAIR + slot);
    let rising = stair(1) / stair(3);
    let true_rising = stair(5) / stair(7);
    let levels = |rise: f64, step: f64| if rise > 0.0 && step > 0.0 { rise / step } else { f64::NAN };
    [
        sum(AREA) / sum(TRUE_AREA),
        anisotropy,
        levels(stair(0), stair(2)),
        levels(stair(4), stair(6)),
        1.0 - rising / true_rising,
    ]
}
