//! SWIMMING along the path: what each frame contributes.
//!
//! Source: METRICS section 2. Range: squared visibility, small negative values are legal. Direction:
//! lower is better. Blind spot: a contribution is measured from the mean over the window, so a
//! single bad frame also lifts the others slightly.

use crate::bootstrap::Stratum;
use crate::cells::check_alike;
use crate::{Bootstrap, MetricsError, Score, TileTable};

/// One window's contributions per frame, with intervals; they add up to the window's SWIMMING.
/// Empty when the window has one frame or no penumbra.
///
/// # Errors
/// None on a table of this crate.
pub fn swimming_per_frame(table: &TileTable, bootstrap: &Bootstrap) -> Result<Vec<Score>, MetricsError> {
    check_alike(&[table])?;
    if table.frames < 2 || table.tiles.iter().all(|t| t.points == 0) {
        return Ok(Vec::new());
    }
    let rows = table.tiles.iter().filter(|t| t.points > 0).map(|tile| {
        let sums = std::iter::once(f64::from(tile.points)).chain(tile.swimming.iter().copied());
        (tile.column, tile.row, sums.collect())
    });
    let means = |sums: &[Vec<f64>]| sums[0][1..].iter().map(|s| s / sums[0][0]).collect();
    let estimates =
        bootstrap.estimate(&[Stratum::new(1 + table.frames as usize, rows, bootstrap.cluster_tiles)], means);
    Ok(estimates.into_iter().map(|e| e.score).collect())
}
