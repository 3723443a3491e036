//! What the noise is like: does it stick to the screen or to the world, and is it white, red or blue.
//!
//! Source: METRICS section 3. Ranges, directions and blind spots: registry entries `lag1_*` and
//! `noise_after_blur`. The main ones: one frame's distance only; lags up to 8 px only. The residual
//! is each seed's difference from the mean over seeds, so neither bias nor motion is in it; the
//! factor (S-1)/S that this costs cancels in every ratio.

use crate::bootstrap::Stratum;
use crate::spectrum::Autocovariance;
use crate::tiles::check_points;
use crate::{Bootstrap, Measurement, MetricsError, Missing, Panel, Tile, Tiling};
use rayon::prelude::*;

// Places in the vector of sums.
const SUCCESSIVE: usize = 0;
const VARIANCE: usize = 1;
const BLURRED: usize = 2;
const STILL: usize = 3;
const SUMS: usize = 4;

/// Sums per tile from which a [`Grain`] is made.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainTable {
    seeds: usize,
    frames: usize,
    rows: Vec<(u32, u32, Vec<f64>)>,
    autocovariance: Autocovariance,
}

/// The character of a variant's noise.
#[derive(Clone, Debug, PartialEq)]
pub struct Grain {
    /// Correlation of the noise between successive frames, -1 to 1. At a fixed pixel or a fixed
    /// point, whichever the panel held.
    pub lag1: Measurement,
    /// Share of the variance that a Gaussian blur of 2 px leaves.
    pub after_blur: Measurement,
    /// Power at each of [`crate::SPECTRUM_FREQUENCIES`], white noise = 1; empty without noise.
    pub spectrum: Vec<f64>,
}

/// Reduces one window to its noise sums.
///
/// `lag1` belongs to the reading: an anchored panel gives it at fixed points, a panel that holds
/// `mask[tiling.pixel[i]]` of every frame gives it at fixed pixels. Patterns must run on from frame
/// to frame (frozen or animated), not be drawn afresh.
///
/// # Errors
/// Inputs of different sizes, NaN at a penumbra point.
pub fn window_grain(panel: &Panel, tiling: &Tiling) -> Result<GrainTable, MetricsError> {
    check_points(panel, tiling)?;
    let residuals = middle_residuals(panel, tiling)?;
    let of_tiles = Autocovariance::of_tiles(&residuals, tiling);
    let autocovariance = Autocovariance::pooled(of_tiles.iter());
    let row = |(tile, own): (&Tile, &Autocovariance)| {
        let mut sums = vec![0.0; SUMS];
        tile.penumbra.iter().for_each(|&point| add_point(&mut sums, panel, point as usize));
        let (blurred, still) = autocovariance.blur_of_tile(own);
        (sums[BLURRED], sums[STILL]) = (blurred, still);
        (tile.column, tile.row, sums)
    };
    let tiles = tiling.tiles.par_iter().zip(&of_tiles).filter(|(t, _)| !t.penumbra.is_empty());
    let rows: Vec<_> = tiles.map(row).collect();
    Ok(GrainTable { seeds: panel.seeds, frames: panel.frames, rows, autocovariance })
}

/// Differences from the seed mean at a point, frame by frame.
fn residuals(panel: &Panel, frame: usize, point: usize) -> impl Iterator<Item = f64> {
    let values = move |seed| f64::from(panel.at(frame, seed, point));
    let mean = (0..panel.seeds).map(values).sum::<f64>() / panel.seeds as f64;
    (0..panel.seeds).map(move |seed| values(seed) - mean)
}

/// Residuals of the middle frame, where anchors are pixels; 0 outside the penumbra. One map a seed.
fn middle_residuals(panel: &Panel, tiling: &Tiling) -> Result<Vec<Vec<f64>>, MetricsError> {
    let frame = panel.frames / 2;
    let mut maps = vec![vec![0.0; panel.points]; panel.seeds];
    for point in tiling.tiles.iter().flat_map(|t| &t.penumbra).map(|&p| p as usize) {
        for (seed, residual) in residuals(panel, frame, point).enumerate() {
            if !residual.is_finite() {
                return Err(MetricsError::NotFinite { what: "the variant", frame, seed, point });
            }
            maps[seed][point] = residual;
        }
    }
    Ok(maps)
}

fn add_point(sums: &mut [f64], panel: &Panel, point: usize) {
    let mut before: Vec<f64> = Vec::new();
    for frame in 0..panel.frames {
        let now: Vec<f64> = residuals(panel, frame, point).collect();
        sums[VARIANCE] += now.iter().map(|n| n * n).sum::<f64>() / panel.frames as f64;
        let product: f64 = before.iter().zip(&now).map(|(a, b)| a * b).sum();
        sums[SUCCESSIVE] += product / (panel.frames.max(2) - 1) as f64;
        before = now;
    }
}

/// Pools windows to the character of the noise.
pub fn grain(tables: &[&GrainTable], bootstrap: &Bootstrap) -> Grain {
    let strata: Vec<Stratum> =
        tables.iter().map(|t| Stratum::new(SUMS, t.rows.iter().cloned(), bootstrap.cluster_tiles)).collect();
    let ratios = |windows: &[Vec<f64>]| {
        let sum = |slot: usize| windows.iter().map(|w| w[slot]).sum::<f64>();
        vec![sum(SUCCESSIVE) / sum(VARIANCE), sum(BLURRED) / sum(STILL)]
    };
    let estimates = bootstrap.estimate(&strata, ratios);
    let missing = |frames_matter: usize| {
        if tables.iter().all(|t| t.rows.is_empty()) {
            Some(Missing::NoPenumbra)
        } else if tables.iter().any(|t| t.seeds < 2) {
            Some(Missing::OneSeed)
        } else if tables.iter().any(|t| t.frames < frames_matter) {
            Some(Missing::OneFrame)
        } else {
            None
        }
    };
    let measured = |index: usize, frames_matter: usize| {
        let score = estimates[index].score;
        let none = if score.value.is_finite() { None } else { Some(Missing::NoNoise) };
        missing(frames_matter).or(none).map_or(Measurement::Measured(score), Measurement::NotMeasured)
    };
    let after_blur = measured(1, 1);
    let pooled = Autocovariance::pooled(tables.iter().map(|t| &t.autocovariance));
    let spectrum = if after_blur.score().is_some() { pooled.spectrum() } else { Vec::new() };
    Grain { lag1: measured(0, 2), after_blur, spectrum }
}
