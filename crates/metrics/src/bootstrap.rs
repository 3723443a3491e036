//! Intervals by resampling tiles: never pixels (neighbours are alike), never seeds (it would shrink
//! the noise by (S-1)/S).
//!
//! Tiles are drawn in square clusters: a quarter-resolution mask with one random offset per 16x16
//! block couples 64x64 pixels, which is 2x2 tiles, and intervals from single tiles then cover 7 times
//! in 10 (see `interval`).
//! Deliberately absent: resampling across windows (each window is its own stratum).

use crate::interval::{Estimate, summary};
use crate::rng::Rng;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// How intervals are made. The same settings and tables give the same bits at any thread count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bootstrap {
    /// Of the random draws.
    pub seed: u64,
    /// Number of resamples; 1000 place each end to about a twentieth of the half-width.
    pub replicates: u32,
    /// Side, in tiles, of the squares that are drawn together.
    pub cluster_tiles: u32,
}

impl Default for Bootstrap {
    fn default() -> Self {
        Self { seed: 0x5eed, replicates: 1000, cluster_tiles: 2 }
    }
}

/// The clusters of one window, each a row of sums.
#[derive(Clone, Debug)]
pub(crate) struct Stratum {
    clusters: Vec<Vec<f64>>,
    width: usize,
}

impl Stratum {
    /// Adds up tiles (column, row, `width` sums) to clusters, in row order.
    pub(crate) fn new(
        width: usize,
        tiles: impl Iterator<Item = (u32, u32, Vec<f64>)>,
        cluster_tiles: u32,
    ) -> Self {
        let side = cluster_tiles.max(1);
        let mut clusters: BTreeMap<(u32, u32), Vec<f64>> = BTreeMap::new();
        for (column, row, sums) in tiles {
            let cluster = clusters.entry((row / side, column / side)).or_insert_with(|| vec![0.0; width]);
            cluster.iter_mut().zip(&sums).for_each(|(c, s)| *c += s);
        }
        Self { clusters: clusters.into_values().collect(), width }
    }

    /// Leaves out clusters in which a sum (a weight: a count of points) is zero: they would only
    /// make the number of clusters look larger.
    pub(crate) fn where_any(mut self, weights: &[usize]) -> Self {
        self.clusters.retain(|cluster| weights.iter().any(|&w| cluster[w] > 0.0));
        self
    }

    /// The sums when each cluster counts so many times.
    fn weighted(&self, weights: &[u32]) -> Vec<f64> {
        let mut sum = vec![0.0; self.width];
        for (cluster, &weight) in self.clusters.iter().zip(weights).filter(|&(_, &weight)| weight > 0) {
            sum.iter_mut().zip(cluster).for_each(|(s, c)| *s += f64::from(weight) * c);
        }
        sum
    }
}

impl Bootstrap {
    /// Values and intervals of a statistic of the windows' sums (one vector a window).
    ///
    /// With fewer than two clusters nothing is known about the spread: the interval is then the value
    /// plus and minus 1, the whole range of a visibility.
    pub(crate) fn estimate(
        &self,
        strata: &[Stratum],
        statistic: impl Fn(&[Vec<f64>]) -> Vec<f64> + Sync,
    ) -> Vec<Estimate> {
        let counts: Vec<usize> = strata.iter().map(|s| s.clusters.len()).collect();
        self.estimate_weighted(&counts, |weights| {
            let sums: Vec<_> = strata.iter().zip(weights).map(|(s, w)| s.weighted(w)).collect();
            statistic(&sums)
        })
    }

    /// As [`Bootstrap::estimate`], of a statistic of how often each cluster of each window counts.
    pub(crate) fn estimate_weighted(
        &self,
        clusters: &[usize],
        statistic: impl Fn(&[Vec<u32>]) -> Vec<f64> + Sync,
    ) -> Vec<Estimate> {
        let values = statistic(&clusters.iter().map(|&n| vec![1; n]).collect::<Vec<_>>());
        let freedom: usize = clusters.iter().map(|n| n.saturating_sub(1)).sum();
        let draw = |replicate: u32| {
            let mut rng = Rng::new(self.seed, u64::from(replicate));
            statistic(&clusters.iter().map(|&n| rng.multinomial(n)).collect::<Vec<_>>())
        };
        let replicates = if freedom == 0 { 0 } else { self.replicates };
        let draws: Vec<Vec<f64>> = (0..replicates).into_par_iter().map(draw).collect();
        let column = |index: usize| draws.iter().map(|row| row[index]).collect();
        let estimate = |(index, &value): (usize, &f64)| summary(value, column(index), freedom);
        values.iter().enumerate().map(estimate).collect()
    }
}
