//! Autocovariance of the noise over the penumbra, and its radial power spectrum.
//!
//! A penumbra is a ragged strip: there is no rectangle to transform. The autocovariance is taken over
//! pairs of penumbra pixels at each lag, and transformed (Wiener-Khinchin) under a Hann window of
//! lags (Blackman and Tukey, *The Measurement of Power Spectra*, 1958).

use crate::{Tile, Tiling};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Largest lag in pixels, in x and in y.
const REACH: i32 = 8;
/// Lags per axis.
const SIDE: usize = 2 * REACH as usize + 1;
/// Place of lag (0, 0).
const MIDDLE: usize = SIDE * SIDE / 2;
/// Deviation in pixels of the blur that stands for the eye.
const BLUR_PX: f64 = 2.0;

/// Radial frequencies of a [`Grain`](crate::Grain)'s spectrum, in cycles per pixel.
pub const SPECTRUM_FREQUENCIES: [f64; 16] = {
    let mut frequencies = [0.0; 16];
    let mut i = 0;
    while i < 16 {
        frequencies[i] = (i as f64 + 0.5) / 32.0;
        i += 1;
    }
    frequencies
};

/// Sums of products and numbers of pairs at each lag, row by row from (-8, -8).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Autocovariance {
    products: Vec<f64>,
    pairs: Vec<f64>,
}

/// Lags (dx, dy) in storage order.
fn lags() -> impl Iterator<Item = (i32, i32)> {
    (-REACH..=REACH).flat_map(|dy| (-REACH..=REACH).map(move |dx| (dx, dy)))
}

/// Penumbra points by pixel.
struct Grid {
    point_at: Vec<u32>,
    size: [i32; 2],
}

const NO_POINT: u32 = u32::MAX;

impl Grid {
    fn new(tiling: &Tiling) -> Self {
        let size = tiling.size.map(|s| s as i32);
        let mut point_at = vec![NO_POINT; tiling.size[0] as usize * tiling.size[1] as usize];
        for &point in tiling.tiles.iter().flat_map(|t| &t.penumbra) {
            point_at[tiling.pixel[point as usize] as usize] = point;
        }
        Self { point_at, size }
    }

    fn neighbour(&self, [x, y]: [u32; 2], (dx, dy): (i32, i32)) -> Option<usize> {
        let (x, y) = (x as i32 + dx, y as i32 + dy);
        if x < 0 || y < 0 || x >= self.size[0] || y >= self.size[1] {
            return None;
        }
        let point = self.point_at[(y * self.size[0] + x) as usize];
        (point != NO_POINT).then_some(point as usize)
    }
}

impl Autocovariance {
    /// Of maps (one a seed) over the penumbra points of each tile; pairs reach into other tiles.
    pub(crate) fn of_tiles(maps: &[Vec<f64>], tiling: &Tiling) -> Vec<Self> {
        let grid = Grid::new(tiling);
        tiling.tiles.par_iter().map(|tile| Self::of_tile(maps, tiling, &grid, tile)).collect()
    }

    fn of_tile(maps: &[Vec<f64>], tiling: &Tiling, grid: &Grid, tile: &Tile) -> Self {
        let mut sums = Self { products: vec![0.0; SIDE * SIDE], pairs: vec![0.0; SIDE * SIDE] };
        // A pair is met from both ends: half of the lags, from the middle on, hold all.
        for &point in &tile.penumbra {
            let place = tiling.place(point);
            for (slot, lag) in lags().enumerate().skip(MIDDLE) {
                if let Some(other) = grid.neighbour(place, lag) {
                    sums.pairs[slot] += maps.len() as f64;
                    sums.products[slot] += maps.iter().map(|m| m[point as usize] * m[other]).sum::<f64>();
                }
            }
        }
        for slot in 0..MIDDLE {
            let mirrored = 2 * MIDDLE - slot;
            sums.pairs[slot] = sums.pairs[mirrored];
            sums.products[slot] = sums.products[mirrored];
        }
        sums
    }

    /// The sums of all.
    pub(crate) fn pooled<'a>(all: impl Iterator<Item = &'a Self>) -> Self {
        let zero = Self { products: vec![0.0; SIDE * SIDE], pairs: vec![0.0; SIDE * SIDE] };
        all.fold(zero, |mut sum, other| {
            sum.products.iter_mut().zip(&other.products).for_each(|(s, o)| *s += o);
            sum.pairs.iter_mut().zip(&other.pairs).for_each(|(s, o)| *s += o);
            sum
        })
    }

    /// A tile's part of the variance after and before the blur, each over the numbers of pairs of
    /// the whole window: their sums over tiles give the ratio.
    pub(crate) fn blur_of_tile(&self, own: &Self) -> (f64, f64) {
        let weights = blur_weights();
        let share =
            |slot: usize| if self.pairs[slot] > 0.0 { own.products[slot] / self.pairs[slot] } else { 0.0 };
        let blurred = (0..SIDE * SIDE).map(|slot| weights[slot] * share(slot)).sum();
        (blurred, share(MIDDLE))
    }

    /// Power at each radial frequency, mean over directions, over that of white noise.
    pub(crate) fn spectrum(&self) -> Vec<f64> {
        const DIRECTIONS: usize = 24;
        let covariance = |slot: usize| self.products[slot] / self.pairs[slot].max(1.0);
        let white = covariance(MIDDLE);
        let hann = |lag: i32| 0.5 + 0.5 * (TAU * 0.5 * f64::from(lag) / f64::from(REACH + 1)).cos();
        let power = |fx: f64, fy: f64| -> f64 {
            let term = |(slot, (dx, dy)): (usize, (i32, i32))| {
                let phase = TAU * (fx * f64::from(dx) + fy * f64::from(dy));
                covariance(slot) * hann(dx) * hann(dy) * phase.cos()
            };
            lags().enumerate().map(term).sum()
        };
        let radial = |f: &f64| {
            let angles = (0..DIRECTIONS).map(|i| TAU * 0.5 * (i as f64 + 0.5) / DIRECTIONS as f64);
            angles.map(|a| power(f * a.cos(), f * a.sin())).sum::<f64>() / (DIRECTIONS as f64 * white)
        };
        SPECTRUM_FREQUENCIES.iter().map(radial).collect()
    }
}

/// The blur's kernel with itself: a Gaussian of sqrt(2) times its deviation, summing to 1.
fn blur_weights() -> Vec<f64> {
    let weight = |(dx, dy): (i32, i32)| (-f64::from(dx * dx + dy * dy) / (4.0 * BLUR_PX * BLUR_PX)).exp();
    let sum: f64 = lags().map(weight).sum();
    lags().map(|lag| weight(lag) / sum).collect()
}
