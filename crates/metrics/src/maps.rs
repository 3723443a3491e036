//! The scores as maps, a value for each anchor: for pictures, percentiles and profiles.

use crate::estimator::{Parts, Series};
use crate::tiles::check;
use crate::{MetricsError, Panel, PanelTruth, Tile, Tiling};
use rayon::prelude::*;

/// One value per point of the panel; NaN at points that are left out, and in the four split maps
/// outside the penumbra.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMaps {
    /// Visibility, mean over frames and seeds.
    pub mean: Vec<f32>,
    /// Mean visibility minus the true one: negative is too dark.
    pub signed_error: Vec<f32>,
    /// Mean over frames and seeds of (v - r1)(v - r2); may be below 0 by reference noise.
    pub squared_error: Vec<f32>,
    /// Root of the motion M, negative estimates shown as 0 (for display only).
    pub swim: Vec<f32>,
    /// Variance between seeds (N).
    pub noise: Vec<f32>,
    /// The four other cells; small negative values are legal.
    pub smooth_static: Vec<f32>,
    /// See `smooth_static`.
    pub smooth_moving: Vec<f32>,
    /// See `smooth_static`.
    pub structured_static: Vec<f32>,
    /// See `smooth_static`.
    pub structured_moving: Vec<f32>,
}

/// Maps of one variant's window.
///
/// # Errors
/// As [`window_tiles`](crate::window_tiles).
pub fn point_maps(panel: &Panel, truth: &PanelTruth, tiling: &Tiling) -> Result<PointMaps, MetricsError> {
    check(panel, truth, tiling)?;
    let tiles: Result<Vec<_>, MetricsError> =
        tiling.tiles.par_iter().map(|tile| tile_values(panel, truth, tile)).collect();
    let values: Vec<(u32, PointValues)> = tiles?.into_iter().flatten().collect();
    let map = |of: &dyn Fn(&PointValues) -> f64| {
        let mut map = vec![f32::NAN; panel.points];
        values.iter().for_each(|(point, value)| map[*point as usize] = of(value) as f32);
        map
    };
    Ok(PointMaps {
        mean: map(&|v| v.mean),
        signed_error: map(&|v| v.signed_error),
        squared_error: map(&|v| v.squared),
        swim: map(&|v| v.total.moving.max(0.0).sqrt()),
        noise: map(&|v| v.total.noise),
        smooth_static: map(&|v| v.smooth.fixed),
        smooth_moving: map(&|v| v.smooth.moving),
        structured_static: map(&|v| v.structured.fixed),
        structured_moving: map(&|v| v.structured.moving),
    })
}

struct PointValues {
    mean: f64,
    signed_error: f64,
    squared: f64,
    total: Parts,
    smooth: Parts,
    structured: Parts,
}

const NONE: Parts = Parts { noise: f64::NAN, moving: f64::NAN, fixed: f64::NAN };

fn tile_values(
    panel: &Panel,
    truth: &PanelTruth,
    tile: &Tile,
) -> Result<Vec<(u32, PointValues)>, MetricsError> {
    let points: Vec<u32> = tile.points().collect();
    let series = Series::of_points(panel, truth, &points)?;
    let inside = Series::of_points(panel, truth, &tile.penumbra)?;
    let smooth = inside.smooth(tile);
    let structured = inside.minus(&smooth);
    let value = |(index, &point): (usize, &u32)| {
        let sums = series.point(index);
        let first = f64::from(panel.at(0, 0, point as usize));
        let count = (panel.frames * panel.seeds) as f64;
        let mean = first + series.seed_rows(index).flatten().sum::<f64>() / count;
        // Penumbra points come first in `points`.
        let in_penumbra = index < tile.penumbra.len();
        let split = |part: &Series| if in_penumbra { part.point(index).parts } else { NONE };
        let (smooth, structured) = (split(&smooth), split(&structured));
        let signed_error = mean - truth.mean(point as usize);
        (
            point,
            PointValues { mean, signed_error, squared: sums.squared, total: sums.parts, smooth, structured },
        )
    };
    Ok(points.iter().enumerate().map(value).collect())
}

impl Series {
    /// The smooth part, point by point.
    fn smooth(&self, tile: &Tile) -> Self {
        let coefficients = self.project(tile);
        let field = |c: &[f64], columns| tile.projection.fields(c, columns);
        let drift = |half: usize| {
            if self.drift[half].is_empty() {
                Vec::new()
            } else {
                field(&coefficients.drift[half], self.frames)
            }
        };
        Self {
            frames: self.frames,
            seeds: self.seeds,
            values: field(&coefficients.values, self.frames * self.seeds),
            drift: [drift(0), drift(1)],
            offset: [0, 1].map(|half| field(&coefficients.offset[half], 1)),
        }
    }

    fn minus(&self, other: &Self) -> Self {
        let minus = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect();
        Self {
            frames: self.frames,
            seeds: self.seeds,
            values: minus(&self.values, &other.values),
            drift: [0, 1].map(|half| minus(&self.drift[half], &other.drift[half])),
            offset: [0, 1].map(|half| minus(&self.offset[half], &other.offset[half])),
        }
    }
}
