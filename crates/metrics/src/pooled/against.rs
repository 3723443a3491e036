//! Two variants at the same points: how far apart, and whether they are the same to the bit.

use super::{SumTable, add};
use crate::tiles::check_points;
use crate::{MetricsError, Panel, Tiling};

pub(super) const POINTS: usize = 0;
const SQUARED: usize = 1;
const VALUES: usize = 2;
const DIFFERING: usize = 3;

/// Sums per tile of the difference between two panels, over all counted points. Panels of different
/// numbers of seeds have a difference of means, and no values that could be the same.
///
/// # Errors
/// Panels that are not of the same points and frames.
pub fn against_sums(a: &Panel, b: &Panel, tiling: &Tiling) -> Result<SumTable, MetricsError> {
    check_points(a, tiling)?;
    check_points(b, tiling)?;
    if a.frames != b.frames {
        return Err(MetricsError::Unlike("panels of different numbers of frames"));
    }
    let row = |tile: &crate::Tile| {
        let mut sums = vec![0.0; 4];
        for point in tile.points().map(|p| p as usize) {
            let difference = mean(a, point) - mean(b, point);
            add(&mut sums, POINTS, &[1.0, difference * difference]);
            let (values, differing) = bits(a, b, point);
            add(&mut sums, VALUES, &[values as f64, differing as f64]);
        }
        (tile.column, tile.row, sums)
    };
    Ok(SumTable { rows: tiling.tiles.iter().map(row).collect() })
}

/// Sums per tile of a panel's values over all counted points.
///
/// # Errors
/// A panel that is not of these points.
pub fn value_sums(panel: &Panel, tiling: &Tiling) -> Result<SumTable, MetricsError> {
    check_points(panel, tiling)?;
    let row = |tile: &crate::Tile| {
        let sum = tile.points().map(|p| mean(panel, p as usize)).sum::<f64>();
        (tile.column, tile.row, vec![tile.points().count() as f64, sum])
    };
    Ok(SumTable { rows: tiling.tiles.iter().map(row).collect() })
}

fn mean(panel: &Panel, point: usize) -> f64 {
    let draws = panel.frames * panel.seeds;
    (0..draws).map(|d| f64::from(panel.values[d * panel.points + point])).sum::<f64>() / draws as f64
}

/// Compared values, and how many of them differ.
fn bits(a: &Panel, b: &Panel, point: usize) -> (usize, usize) {
    let draws = a.frames * a.seeds;
    if a.seeds != b.seeds {
        return (draws, draws);
    }
    let bits = |panel: &Panel, draw: usize| panel.values[draw * panel.points + point].to_bits();
    (draws, (0..draws).filter(|&d| bits(a, d) != bits(b, d)).count())
}

pub(super) fn squared(sums: &[f64]) -> f64 {
    sums[SQUARED] / sums[POINTS]
}

pub(super) fn differing(sums: &[f64]) -> f64 {
    sums[DIFFERING] / sums[VALUES]
}

pub(super) fn value(sums: &[f64]) -> f64 {
    sums[1] / sums[POINTS]
}
