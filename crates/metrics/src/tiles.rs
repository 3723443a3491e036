//! A window reduced to sums per tile: all that scores, intervals and paired tests need.
//!
//! A panel of a megapixel window takes hundreds of megabytes, its table a few hundred kilobytes; the
//! panel can be dropped once the table is made. Tables are serialisable: a baseline keeps them.

use crate::error::expect_length;
use crate::estimator::{Parts, Series};
use crate::{MetricsError, Panel, PanelTruth, Tile, Tiling};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// The sums of one window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TileTable {
    /// Frames of the window (T).
    pub frames: u32,
    /// Seeds per frame (S).
    pub seeds: u32,
    /// Side of a tile in pixels of the middle frame.
    pub tile_px: u32,
    /// One row a tile, in the tiling's order.
    pub tiles: Vec<TileRow>,
}

/// Sums over the points of one tile. Divide by `points` for means.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TileRow {
    /// Column, in tiles.
    pub column: u32,
    /// Row, in tiles.
    pub row: u32,
    /// Penumbra points.
    pub points: u32,
    /// Functions of the projection.
    pub functions: u32,
    /// The parts of Pe.
    pub smooth: Parts,
    /// The parts of (1-P)e.
    pub structured: Parts,
    /// Mean over frames and seeds of the product of the two errors: the MSE, times points.
    pub squared: f64,
    /// Contribution of each frame to the motion.
    pub swimming: Vec<f64>,
    /// Mean squared change of the error between successive frames, less its noise.
    pub successive: f64,
    /// Noise of the truth itself, `(r1 - r2)^2 / 4` (mean over its frames).
    pub reference: f64,
    /// Umbra points of the tile.
    pub umbra: Outside,
    /// Lit points of the tile.
    pub lit: Outside,
}

/// Sums over the points of a tile outside the penumbra.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outside {
    /// How many.
    pub points: u32,
    /// Mean over frames and seeds of what is plainly wrong: v in the umbra, 1 - v in full light.
    pub wrong: f64,
    /// As [`TileRow::squared`].
    pub squared: f64,
}

/// Reduces one variant's window to sums per tile.
///
/// The same bits at any thread count: tiles are independent, and summed in their own order.
///
/// # Errors
/// Inputs of different sizes; NaN or infinity at a counted point.
pub fn window_tiles(panel: &Panel, truth: &PanelTruth, tiling: &Tiling) -> Result<TileTable, MetricsError> {
    check(panel, truth, tiling)?;
    let tiles: Result<Vec<TileRow>, MetricsError> =
        tiling.tiles.par_iter().map(|tile| tile_row(panel, truth, tile)).collect();
    Ok(TileTable {
        frames: panel.frames as u32,
        seeds: panel.seeds as u32,
        tile_px: tiling.tile_px,
        tiles: tiles?,
    })
}

/// That panel, truth and tiling are about the same points and frames.
pub(crate) fn check(panel: &Panel, truth: &PanelTruth, tiling: &Tiling) -> Result<(), MetricsError> {
    check_points(panel, tiling)?;
    truth.check(panel.points)?;
    if truth.frames != 1 {
        expect_length("frames of the truth", panel.frames, truth.frames)?;
    }
    Ok(())
}

/// That panel and tiling are about the same points.
pub(crate) fn check_points(panel: &Panel, tiling: &Tiling) -> Result<(), MetricsError> {
    panel.check()?;
    expect_length("points of the tiling", panel.points, tiling.points())
}

fn tile_row(panel: &Panel, truth: &PanelTruth, tile: &Tile) -> Result<TileRow, MetricsError> {
    let series = Series::of_points(panel, truth, &tile.penumbra)?;
    let total = series.sums();
    let smooth = series.project(tile).sums().parts;
    Ok(TileRow {
        column: tile.column,
        row: tile.row,
        points: tile.penumbra.len() as u32,
        functions: tile.projection.functions() as u32,
        smooth,
        structured: total.parts.minus(smooth),
        squared: total.squared,
        swimming: total.per_frame,
        successive: total.successive,
        reference: tile.penumbra.iter().map(|&p| reference_noise(truth, p)).sum(),
        umbra: outside(panel, (truth, 0.0), &tile.umbra, |v, g| v - g)?,
        lit: outside(panel, (truth, 1.0), &tile.lit, |v, g| g - v)?,
    })
}

fn outside(
    panel: &Panel,
    (truth, flat): (&PanelTruth, f64),
    points: &[u32],
    wrong: impl Fn(f64, f64) -> f64,
) -> Result<Outside, MetricsError> {
    let series = Series::of_points(panel, truth, points)?;
    let mut sums = Outside { points: points.len() as u32, wrong: 0.0, squared: series.sums().squared };
    for (index, &point) in points.iter().enumerate() {
        let first = f64::from(panel.at(0, 0, point as usize));
        // A truth of each frame is that of pixels, which may lie beside a narrow shadow's anchor: in the middle
        // frame the anchor is the pixel's centre.
        let mean =
            |frame| f64::from(truth.half(0, frame, point as usize) + truth.half(1, frame, point as usize));
        let true_value = |frame: usize| flat + 0.5 * (mean(frame) - mean(panel.frames / 2));
        let frames = series.seed_rows(index).enumerate();
        let sum: f64 = frames
            .map(|(frame, row)| row.iter().map(|v| wrong(v + first, true_value(frame))).sum::<f64>())
            .sum();
        sums.wrong += sum / (panel.frames * panel.seeds) as f64;
    }
    Ok(sums)
}

fn reference_noise(truth: &PanelTruth, point: u32) -> f64 {
    let difference =
        |t| f64::from(truth.half(0, t, point as usize)) - f64::from(truth.half(1, t, point as usize));
    (0..truth.frames).map(|t| difference(t) * difference(t)).sum::<f64>() / (4 * truth.frames) as f64
}

impl Series {
    /// The series of some points of a panel.
    pub(crate) fn of_points(panel: &Panel, truth: &PanelTruth, points: &[u32]) -> Result<Self, MetricsError> {
        let mut series = Self { frames: panel.frames, seeds: panel.seeds, ..Self::default() };
        series.values.reserve(points.len() * panel.frames * panel.seeds);
        for &point in points {
            series.push(panel, truth, point as usize)?;
        }
        Ok(series)
    }

    fn push(&mut self, panel: &Panel, truth: &PanelTruth, point: usize) -> Result<(), MetricsError> {
        let first = f64::from(panel.at(0, 0, point));
        for frame in 0..panel.frames {
            for seed in 0..panel.seeds {
                let value = f64::from(panel.at(frame, seed, point));
                if !value.is_finite() {
                    return Err(MetricsError::NotFinite { what: "the variant", frame, seed, point });
                }
                self.values.push(value - first);
            }
        }
        for half in 0..2 {
            let true_first = f64::from(truth.half(half, 0, point));
            if truth.frames > 1 {
                let drift = |t| f64::from(truth.half(half, t, point)) - true_first;
                self.drift[half].extend((0..panel.frames).map(drift));
            }
            self.offset[half].push(first - true_first);
        }
        Ok(())
    }

    /// The coefficients of these points' series in a tile's smooth space.
    pub(crate) fn project(&self, tile: &Tile) -> Self {
        let project = |fields: &[f64], columns| tile.projection.project(fields, columns);
        let drift = |half: usize| {
            if self.drift[half].is_empty() { Vec::new() } else { project(&self.drift[half], self.frames) }
        };
        Self {
            frames: self.frames,
            seeds: self.seeds,
            values: project(&self.values, self.frames * self.seeds),
            drift: [drift(0), drift(1)],
            offset: [project(&self.offset[0], 1), project(&self.offset[1], 1)],
        }
    }
}
