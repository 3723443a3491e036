//! Differences between two variants, or a run and its baseline, on the same tiles.
//!
//! Same tiles, frames and (where patterns are shared) seeds: what both do wrong cancels, and the
//! interval of the difference is far narrower than that of either. METRICS section 2.

use crate::bootstrap::Stratum;
use crate::cells::check_alike;
use crate::interval::Estimate;
use crate::quantity::{SUMS, sums};
use crate::{Bootstrap, Measurement, MetricsError, Missing, Quantity, TileTable};

/// `a` minus `b`.
///
/// # Errors
/// Tables that were not made from the same tiles, points and frames.
pub fn paired(
    a: &[&TileTable],
    b: &[&TileTable],
    what: Quantity,
    bootstrap: &Bootstrap,
) -> Result<Measurement, MetricsError> {
    Ok(match paired_estimate(a, b, what, bootstrap)? {
        Ok(estimate) if !estimate.score.value.is_finite() => Measurement::NotMeasured(Missing::NoError),
        Ok(estimate) => Measurement::Measured(estimate.score),
        Err(missing) => Measurement::NotMeasured(missing),
    })
}

/// What a reading at pixels adds to SWIMMING because static edges move across them: the pixel
/// reading's SWIMMING minus the anchored one's.
///
/// # Errors
/// As [`paired`].
pub fn edge_crawl(
    pixels: &[&TileTable],
    anchored: &[&TileTable],
    bootstrap: &Bootstrap,
) -> Result<Measurement, MetricsError> {
    paired(pixels, anchored, Quantity::Swimming, bootstrap)
}

pub(crate) fn paired_estimate(
    a: &[&TileTable],
    b: &[&TileTable],
    what: Quantity,
    bootstrap: &Bootstrap,
) -> Result<Result<Estimate, Missing>, MetricsError> {
    check_alike(&[a, b].concat())?;
    if a.len() != b.len() {
        return Err(MetricsError::Unlike("different numbers of windows"));
    }
    if let Some(missing) = what.missing(a).or(what.missing(b)) {
        return Ok(Err(missing));
    }
    // Both tables hold the same points, so the first's counts serve.
    let weights = what.seen_by();
    let strata: Result<Vec<_>, _> =
        a.iter().zip(b).map(|(a, b)| Ok(joined(a, b, bootstrap)?.where_any(weights))).collect();
    let difference = |sums: &[Vec<f64>]| {
        let (first, second): (Vec<_>, Vec<_>) =
            sums.iter().map(|s| (s[..SUMS].to_vec(), s[SUMS..].to_vec())).unzip();
        vec![what.value(&first) - what.value(&second)]
    };
    Ok(Ok(bootstrap.estimate(&strata?, difference)[0]))
}

/// The sums of both, tile by tile.
fn joined(a: &TileTable, b: &TileTable, bootstrap: &Bootstrap) -> Result<Stratum, MetricsError> {
    let key = |t: &crate::TileRow| (t.column, t.row, t.points, t.umbra.points, t.lit.points);
    if a.tiles.len() != b.tiles.len() || a.tiles.iter().zip(&b.tiles).any(|(a, b)| key(a) != key(b)) {
        return Err(MetricsError::Unlike("different tiles or points"));
    }
    let rows = a.tiles.iter().zip(&b.tiles).map(|(a, b)| (a.column, a.row, [sums(a), sums(b)].concat()));
    Ok(Stratum::new(2 * SUMS, rows, bootstrap.cluster_tiles))
}
