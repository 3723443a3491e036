//! The unbiased estimators of noise, motion and bias (METRICS section 2), summed over points.
//!
//! Everything is taken relative to the first value at each point, so that a variant which says the
//! same in all frames has a motion of exactly 0. The same sums serve points and coefficients of the
//! projection: a coefficient is a point with a series like any other.

use serde::{Deserialize, Serialize};

/// Sums over points of the three parts of the mean squared error: they add up to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Parts {
    /// What differs between seeds (N).
    pub noise: f64,
    /// What moves with the camera or the light (M).
    pub moving: f64,
    /// What stands still (B).
    pub fixed: f64,
}

impl Parts {
    /// All three.
    pub fn total(&self) -> f64 {
        self.noise + self.moving + self.fixed
    }

    pub(crate) fn minus(self, other: Self) -> Self {
        Self {
            noise: self.noise - other.noise,
            moving: self.moving - other.moving,
            fixed: self.fixed - other.fixed,
        }
    }
}

/// The series of one or more points. `values` holds frames x seeds numbers a point, relative to the
/// point's first; `drift` the truth's frames relative to its first (empty when it stands still);
/// `offset` the first value minus the truth's first, for each half.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series {
    pub(crate) frames: usize,
    pub(crate) seeds: usize,
    pub(crate) values: Vec<f64>,
    pub(crate) drift: [Vec<f64>; 2],
    pub(crate) offset: [Vec<f64>; 2],
}

/// Sums over points, per frame where frames differ.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Sums {
    pub(crate) parts: Parts,
    /// Mean over frames and seeds of the product of the two errors: the MSE, times points.
    pub(crate) squared: f64,
    /// Contribution of each frame to the motion; they add up to `parts.moving`.
    pub(crate) per_frame: Vec<f64>,
    /// Mean over successive frames of the squared change of the error, less its noise.
    pub(crate) successive: f64,
}

impl Series {
    /// Number of points (or coefficients).
    pub(crate) fn len(&self) -> usize {
        self.offset[0].len()
    }

    /// Sums over all points.
    pub(crate) fn sums(&self) -> Sums {
        (0..self.len()).fold(RawSums::new(self.frames), |raw, point| raw.add(self, point)).finish(self)
    }

    /// The sums of one point.
    pub(crate) fn point(&self, point: usize) -> Sums {
        RawSums::new(self.frames).add(self, point).finish(self)
    }

    /// Errors per frame relative to the first (seed mean), for one half.
    fn errors(&self, half: usize, point: usize) -> impl Iterator<Item = f64> {
        let drift = self.drift[half].get(point * self.frames..(point + 1) * self.frames);
        self.seed_rows(point).enumerate().map(move |(t, row)| {
            row.iter().sum::<f64>() / row.len() as f64 - drift.map_or(0.0, |drift| drift[t])
        })
    }

    /// The values of each frame's seeds.
    pub(crate) fn seed_rows(&self, point: usize) -> impl Iterator<Item = &[f64]> {
        let stride = self.frames * self.seeds;
        self.values[point * stride..(point + 1) * stride].chunks_exact(self.seeds)
    }

    /// Errors of all frames and seeds against one half, in order.
    fn absolute(&self, half: usize, point: usize) -> impl Iterator<Item = f64> {
        let drift = self.drift[half].get(point * self.frames..(point + 1) * self.frames);
        let offset = self.offset[half][point];
        self.seed_rows(point).enumerate().flat_map(move |(t, row)| {
            let shift = offset - drift.map_or(0.0, |drift| drift[t]);
            row.iter().map(move |v| v + shift)
        })
    }
}

/// Sums before the noise is taken out of them.
struct RawSums {
    /// Per frame, squared deviations of the seeds from their mean.
    spread: Vec<f64>,
    /// Per frame, product of the deviations of the two errors from their means over frames.
    moving: Vec<f64>,
    /// Per pair of successive frames, product of the changes of the two errors.
    change: f64,
    fixed: f64,
    squared: f64,
}

impl RawSums {
    fn new(frames: usize) -> Self {
        Self { spread: vec![0.0; frames], moving: vec![0.0; frames], change: 0.0, fixed: 0.0, squared: 0.0 }
    }

    fn add(mut self, series: &Series, point: usize) -> Self {
        for (spread, row) in self.spread.iter_mut().zip(series.seed_rows(point)) {
            let mean = row.iter().sum::<f64>() / row.len() as f64;
            *spread += row.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
        }
        let count = series.frames as f64;
        let [a, b] = [0, 1].map(|half| series.errors(half, point).collect::<Vec<f64>>());
        let [mean_a, mean_b] = [&a, &b].map(|e| e.iter().sum::<f64>() / count);
        for (moving, (a, b)) in self.moving.iter_mut().zip(a.iter().zip(&b)) {
            *moving += (a - mean_a) * (b - mean_b);
        }
        self.change +=
            a.windows(2).zip(b.windows(2)).map(|(a, b)| (a[1] - a[0]) * (b[1] - b[0])).sum::<f64>();
        self.fixed += (mean_a + series.offset[0][point]) * (mean_b + series.offset[1][point]);
        let products = series.absolute(0, point).zip(series.absolute(1, point)).map(|(a, b)| a * b);
        self.squared += products.sum::<f64>() / (count * series.seeds as f64);
        self
    }

    /// Takes the noise out. Per frame, the noise in `(v_t - v)^2` is `N_t (1 - 2/T)/S + N/(TS)`,
    /// which stays unbiased when frames differ in noise and sums to METRICS' `N (T-1)/(TS)`.
    fn finish(self, series: &Series) -> Sums {
        let (t, s) = (series.frames as f64, series.seeds as f64);
        let of_frame = |spread: &f64| if series.seeds > 1 { spread / (s - 1.0) } else { 0.0 };
        let noises: Vec<f64> = self.spread.iter().map(of_frame).collect();
        let noise = noises.iter().sum::<f64>() / t;
        let per_frame: Vec<f64> = self
            .moving
            .iter()
            .zip(&noises)
            .map(|(moving, n)| (moving - n * (1.0 - 2.0 / t) / s - noise / (t * s)) / t)
            .collect();
        let pairs = (t - 1.0).max(1.0);
        let pair_noise: f64 = noises.windows(2).map(|n| (n[0] + n[1]) / s).sum();
        let fixed = self.fixed - noise / (t * s);
        Sums {
            parts: Parts { noise, moving: per_frame.iter().sum(), fixed },
            squared: self.squared,
            successive: (self.change - pair_noise) / pairs,
            per_frame,
        }
    }
}
