//! Radii and widths of penumbrae on their surface, in metres, and what follows from them.
//!
//! A straight edge under a disc light has visibility V(u) = 1/2 + (u sqrt(1-u^2) + asin u) / pi at
//! u = distance / r (TECHNIQUES, D1), so a point's g and the gradient of g on the surface give r.
//! Blind spots: bent edges, two edges over each other and truth's own noise change r as well.

use super::blocks::blocks;
use super::{SumTable, add};
use crate::edges::{Slope, Slopes};
use crate::tiles::check;
use crate::{MetricsError, Panel, PanelTruth, PointMaps, Region, Tile, Tiling};
use rayon::prelude::*;
use std::f64::consts::PI;
use umbrage_frame::Anchors;

// Places in the vector of sums. A regression is 6 sums: weight, x, y, xx, yy, xy.
pub(super) const POINTS: usize = 0;
const SIGNED: usize = 1;
pub(super) const GROWTH: usize = 2;
pub(super) const NOISE: usize = 8;
pub(super) const SWIM: usize = 14;
const SUMS: usize = 20;

/// Side in pixels of the blocks within which radii change, and of those that have one width.
const CHANGE_SIDE: u32 = 8;
const WIDTH_SIDE: u32 = 16;
/// Fewest points with a radius in a block: a quarter of it.
const FEWEST: usize = 16;
/// Least mean variance of a single tap in a block: it is nearly all lit or dark otherwise.
const LEAST_TAP: f64 = 0.01;
/// Where the profile is steep enough to tell a radius.
const STEEP: std::ops::Range<f64> = 0.05..0.95;
/// The 10-90 % width.
const WIDTH: std::ops::Range<f64> = 0.1..0.9;

/// Sums per tile of a variant's window; `maps` are those of the same panel.
///
/// # Errors
/// As [`window_tiles`](crate::window_tiles).
pub fn width_sums(
    (panel, maps): (&Panel, &PointMaps),
    truth: &PanelTruth,
    anchors: &Anchors,
    tiling: &Tiling,
) -> Result<SumTable, MetricsError> {
    check(panel, truth, tiling)?;
    crate::error::expect_length("anchors", panel.points, anchors.len())?;
    let slopes = Slopes::new(anchors, &truth.basis, tiling);
    let view = View { maps, truth, tiling, slopes: &slopes };
    let row = |tile: &Tile| (tile.column, tile.row, view.sums(tile));
    Ok(SumTable { rows: tiling.tiles.par_iter().map(row).collect() })
}

/// The true 10-90 % width in metres at each penumbra point: that of the 16x16 pixels which it lies in. NaN
/// outside the penumbra, and where too few points of the block rise for a width to be told.
///
/// # Errors
/// Inputs that are not about the same points.
pub fn true_widths(truth: &PanelTruth, anchors: &Anchors, tiling: &Tiling) -> Result<Vec<f32>, MetricsError> {
    truth.check(anchors.len())?;
    crate::error::expect_length("points of the tiling", anchors.len(), tiling.points())?;
    let slopes = Slopes::new(anchors, &truth.basis, tiling);
    let g = |point: u32| f64::from(truth.basis[point as usize]);
    let mut widths = vec![f32::NAN; anchors.len()];
    for tile in &tiling.tiles {
        let all: Vec<u32> = tile.points().collect();
        for block in blocks(&all, tiling, WIDTH_SIDE).values() {
            let Some(width) = Block::new(block, &slopes, &g).width(&g) else { continue };
            let inside = block.iter().filter(|&&p| tiling.regions[p as usize] == Region::Penumbra);
            inside.for_each(|&p| widths[p as usize] = width as f32);
        }
    }
    Ok(widths)
}

/// The points of a block whose slope is known, and the length of the edge in it.
struct Block {
    sloped: Vec<(u32, Slope)>,
    /// Metres, by the coarea formula.
    length: f64,
    /// Points between 10 and 90 %.
    rising: usize,
}

impl Block {
    fn new(block: &[u32], slopes: &Slopes, g: &dyn Fn(u32) -> f64) -> Self {
        let sloped: Vec<(u32, Slope)> = block.iter().filter_map(|&p| Some((p, slopes.at(p)?))).collect();
        let length = sloped.iter().map(|(_, s)| s.footprint * s.steepness).sum();
        let rising = sloped.iter().filter(|(p, _)| WIDTH.contains(&g(*p))).count();
        Self { sloped, length, rising }
    }

    /// Area between 10 and 90 % over the length of the edge, in metres.
    fn width(&self, v: &dyn Fn(u32) -> f64) -> Option<f64> {
        let inside = self.sloped.iter().filter(|(p, _)| WIDTH.contains(&v(*p)));
        let width = inside.map(|(_, s)| s.footprint).sum::<f64>() / self.length;
        (self.rising >= FEWEST && width.is_finite() && width > 0.0).then_some(width)
    }
}

struct View<'a> {
    maps: &'a PointMaps,
    truth: &'a PanelTruth,
    tiling: &'a Tiling,
    slopes: &'a Slopes<'a>,
}

impl View<'_> {
    fn sums(&self, tile: &Tile) -> Vec<f64> {
        let mut sums = vec![0.0; SUMS];
        for &point in &tile.penumbra {
            add(&mut sums, POINTS, &[1.0, f64::from(self.maps.signed_error[point as usize])]);
        }
        for block in blocks(&tile.penumbra, self.tiling, CHANGE_SIDE).values() {
            if let Some((change, noise, swim)) = self.change(block) {
                add(&mut sums, NOISE, &products(1.0, change, noise));
                add(&mut sums, SWIM, &products(1.0, change, swim));
            }
        }
        let all: Vec<u32> = tile.points().collect();
        for block in blocks(&all, self.tiling, WIDTH_SIDE).values() {
            if let Some((weight, true_width, width)) = self.widths(block) {
                add(&mut sums, GROWTH, &products(weight, true_width.ln(), width.ln()));
            }
        }
        sums
    }

    fn g(&self, point: u32) -> f64 {
        f64::from(self.truth.basis[point as usize])
    }

    /// How much ln r changes within a block, and the roots of its noise (over that of a single tap)
    /// and of its motion.
    fn change(&self, block: &[u32]) -> Option<(f64, f64, f64)> {
        let inside: Vec<(u32, f64)> = block
            .iter()
            .filter(|&&p| STEEP.contains(&self.g(p)))
            .filter_map(|&p| Some((p, radius(self.g(p), self.slopes.at(p)?)?.ln())))
            .collect();
        if inside.len() < FEWEST {
            return None;
        }
        let count = inside.len() as f64;
        let mean = inside.iter().map(|(_, r)| r).sum::<f64>() / count;
        let variance = inside.iter().map(|(_, r)| (r - mean).powi(2)).sum::<f64>() / count;
        let sum = |of: &dyn Fn(usize) -> f64| inside.iter().map(|&(p, _)| of(p as usize)).sum::<f64>();
        // Of the variant's own mean: a kernel of the wrong width must not look noisy for it.
        let tap = sum(&|p| f64::from(self.maps.mean[p]) * (1.0 - f64::from(self.maps.mean[p])));
        if tap <= LEAST_TAP * count {
            return None;
        }
        let noise = sum(&|p| f64::from(self.maps.noise[p])) / tap;
        let moving =
            sum(&|p| f64::from(self.maps.smooth_moving[p]) + f64::from(self.maps.structured_moving[p]));
        let root = |v: f64| v.signum() * v.abs().sqrt();
        Some((variance.sqrt(), root(noise), root(moving / count)))
    }

    /// Points that rise, and the true and the measured 10-90 % width in metres.
    fn widths(&self, block: &[u32]) -> Option<(f64, f64, f64)> {
        let of = Block::new(block, self.slopes, &|p| self.g(p));
        let measured = of.width(&|p| f64::from(self.maps.mean[p as usize]))?;
        Some((of.rising as f64, of.width(&|p| self.g(p))?, measured))
    }
}

/// Radius of the penumbra in metres from the truth at a point.
fn radius(g: f64, slope: Slope) -> Option<f64> {
    let u = distance_of(g);
    let r = 2.0 * (1.0 - u * u).max(0.0).sqrt() / (PI * slope.steepness);
    (r.is_finite() && r > 0.0).then_some(r)
}

/// Inverse of V(u), by bisection: 40 halvings leave 1e-12.
fn distance_of(g: f64) -> f64 {
    let v = |u: f64| 0.5 + (u * (1.0 - u * u).max(0.0).sqrt() + u.asin()) / PI;
    let (mut low, mut high) = (-1.0f64, 1.0f64);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if v(middle) < g { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

fn products(weight: f64, x: f64, y: f64) -> [f64; 6] {
    [weight, weight * x, weight * y, weight * x * x, weight * y * y, weight * x * y]
}

pub(super) fn signed(sums: &[f64]) -> f64 {
    sums[SIGNED] / sums[POINTS]
}

/// Variances of x and y and their covariance, over all windows.
fn spread(windows: &[Vec<f64>], at: usize) -> [f64; 3] {
    let sum = |slot: usize| windows.iter().map(|w| w[at + slot]).sum::<f64>();
    let (n, x, y) = (sum(0), sum(1), sum(2));
    [sum(3) / n - x * x / (n * n), sum(4) / n - y * y / (n * n), sum(5) / n - x * y / (n * n)]
}

/// Slope of ln width over ln true width.
pub(super) fn growth(windows: &[Vec<f64>]) -> f64 {
    let [x, _, xy] = spread(windows, GROWTH);
    xy / x
}

pub(super) fn correlation(windows: &[Vec<f64>], at: usize) -> f64 {
    let [x, y, xy] = spread(windows, at);
    xy / (x * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_edge_gives_its_radius_back_at_every_point() {
        let r = 0.035;
        for step in -8..=8 {
            let u = f64::from(step) / 10.0;
            let g = 0.5 + (u * (1.0 - u * u).sqrt() + u.asin()) / PI;
            let steepness = 2.0 * (1.0 - u * u).sqrt() / (PI * r);
            let found = radius(g, Slope { steepness, footprint: 1.0, gradient: [0.0; 2] }).expect("a slope");
            // The bisection stops 1e-12 from u.
            assert!((found / r - 1.0).abs() < 1e-9, "{u}: {found}");
        }
    }

    #[test]
    fn exponents_and_correlations_of_known_points() {
        let sums = |points: &[(f64, f64)]| {
            let mut sums = vec![0.0; SUMS];
            for &(x, y) in points {
                add(&mut sums, GROWTH, &products(2.0, x, y));
                add(&mut sums, NOISE, &products(1.0, x, y));
            }
            vec![sums]
        };
        let line = sums(&[(0.0, 1.0), (1.0, 1.5), (3.0, 2.5)]);
        assert!((growth(&line) - 0.5).abs() < 1e-12 && (correlation(&line, NOISE) - 1.0).abs() < 1e-12);
        let flat = sums(&[(0.0, 1.0), (1.0, 1.0), (3.0, 1.0)]);
        assert!(growth(&flat).abs() < 1e-12);
        let square = sums(&[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)]);
        assert!(correlation(&square, NOISE).abs() < 1e-12);
    }
}
