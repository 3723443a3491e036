//! ERROR and NOISE of means over 4x4 px: what is left when a filter, or an eye far away, averages.

use super::{SumTable, add};
use crate::tiles::check;
use crate::{MetricsError, Panel, PanelTruth, Tile, Tiling};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Side of a block in pixels of the middle frame; tiles are multiples of it.
const SIDE: u32 = 4;
/// Fewest penumbra points of a block: half of it.
const FEWEST: usize = 8;

pub(super) const COUNT: usize = 0;
const SQUARED: usize = 1;
const NOISE: usize = 2;

/// Sums per tile over its blocks.
///
/// # Errors
/// As [`window_tiles`](crate::window_tiles).
pub fn block_sums(panel: &Panel, truth: &PanelTruth, tiling: &Tiling) -> Result<SumTable, MetricsError> {
    check(panel, truth, tiling)?;
    let row = |tile: &Tile| {
        let mut sums = vec![0.0; 3];
        for block in blocks(&tile.penumbra, tiling, SIDE).values().filter(|b| b.len() >= FEWEST) {
            let (squared, noise) = of_block(panel, truth, block);
            add(&mut sums, COUNT, &[1.0, squared, noise]);
        }
        (tile.column, tile.row, sums)
    };
    Ok(SumTable { rows: tiling.tiles.par_iter().map(row).collect() })
}

/// Points by the square of `side` pixels that they lie in.
pub(super) fn blocks(points: &[u32], tiling: &Tiling, side: u32) -> BTreeMap<[u32; 2], Vec<u32>> {
    let mut blocks: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
    for &point in points {
        blocks.entry(tiling.place(point).map(|p| p / side)).or_default().push(point);
    }
    blocks
}

/// Mean squared error with two independent truths, and the variance between seeds, of a block's mean.
fn of_block(panel: &Panel, truth: &PanelTruth, block: &[u32]) -> (f64, f64) {
    let mean = |of: &dyn Fn(usize) -> f32| {
        block.iter().map(|&p| f64::from(of(p as usize))).sum::<f64>() / block.len() as f64
    };
    let (mut squared, mut noise) = (0.0, 0.0);
    for frame in 0..panel.frames {
        let g = [0, 1].map(|half| mean(&|p| truth.half(half, frame, p)));
        let v: Vec<f64> = (0..panel.seeds).map(|seed| mean(&|p| panel.at(frame, seed, p))).collect();
        let over_seeds = v.iter().sum::<f64>() / v.len() as f64;
        squared += v.iter().map(|v| (v - g[0]) * (v - g[1])).sum::<f64>() / v.len() as f64;
        noise += v.iter().map(|v| (v - over_seeds).powi(2)).sum::<f64>() / (v.len().max(2) - 1) as f64;
    }
    (squared / panel.frames as f64, noise / panel.frames as f64)
}

pub(super) fn squared(sums: &[f64]) -> f64 {
    sums[SQUARED] / sums[COUNT]
}

pub(super) fn noise(sums: &[f64]) -> f64 {
    sums[NOISE] / sums[COUNT]
}
