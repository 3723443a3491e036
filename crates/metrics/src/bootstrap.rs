//! Intervals by resampling tiles: never pixels (neighbours are alike), never seeds (it would shrink
//! the noise by (S-1)/S).
//!
//! Tiles are drawn in square clusters: a quarter-resolution mask with one random offset per 16x16
//! block couples 64x64 pixels, which is 2x2 tiles. The percentile interval is widened for few
//! clusters as in Hesterberg, *What Teachers Should Know About the Bootstrap* (2015), section 5.3.
//! Deliberately absent: resampling across windows (each window is its own stratum).

use crate::Score;
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};
use std::collections::BTreeMap;

/// How intervals are made. The same settings and tables give the same bits at any thread count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bootstrap {
    /// Of the random draws.
    pub seed: u64,
    /// Number of resamples; 1000 resolve the 2.5 % tails to about a tenth of the interval.
    pub replicates: u32,
    /// Side, in tiles, of the squares that are drawn together.
    pub cluster_tiles: u32,
}

impl Default for Bootstrap {
    fn default() -> Self {
        Self { seed: 0x5eed, replicates: 1000, cluster_tiles: 2 }
    }
}

/// Probability that an interval covers the true value.
pub(crate) const CONFIDENCE: f64 = 0.95;

/// The clusters of one window, each a row of sums.
#[derive(Clone, Debug)]
pub(crate) struct Stratum {
    clusters: Vec<Vec<f64>>,
    width: usize,
}

/// A value with its interval, and what a test needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Estimate {
    pub(crate) score: Score,
    /// Spread of the resampled values.
    pub(crate) standard_error: f64,
    /// Clusters less strata; 0 when nothing is known about the spread.
    pub(crate) freedom: usize,
}

impl Stratum {
    /// Adds up tiles (column, row, sums) to clusters, in row order.
    pub(crate) fn new(tiles: impl Iterator<Item = (u32, u32, Vec<f64>)>, cluster_tiles: u32) -> Self {
        let side = cluster_tiles.max(1);
        let mut clusters: BTreeMap<(u32, u32), Vec<f64>> = BTreeMap::new();
        let mut width = 0;
        for (column, row, sums) in tiles {
            width = sums.len();
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

    fn total(&self) -> Vec<f64> {
        sum_rows(self.clusters.iter(), self.width)
    }

    fn resampled(&self, rng: &mut Rng) -> Vec<f64> {
        let n = self.clusters.len();
        sum_rows((0..n).map(|_| &self.clusters[rng.below(n)]), self.width)
    }
}

fn sum_rows<'a>(rows: impl Iterator<Item = &'a Vec<f64>>, width: usize) -> Vec<f64> {
    rows.fold(vec![0.0; width], |mut sum, row| {
        sum.iter_mut().zip(row).for_each(|(s, r)| *s += r);
        sum
    })
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
        let values = statistic(&strata.iter().map(Stratum::total).collect::<Vec<_>>());
        let freedom: usize = strata.iter().map(|s| s.clusters.len().saturating_sub(1)).sum();
        let draw = |replicate: u32| {
            let mut rng = Rng::new(self.seed, u64::from(replicate));
            statistic(&strata.iter().map(|s| s.resampled(&mut rng)).collect::<Vec<_>>())
        };
        let draws: Vec<Vec<f64>> =
            if freedom == 0 { Vec::new() } else { (0..self.replicates).into_par_iter().map(draw).collect() };
        let column = |index: usize| draws.iter().map(|d| d[index]).filter(|d| d.is_finite()).collect();
        values.iter().enumerate().map(|(index, &value)| summary(value, column(index), freedom)).collect()
    }
}

fn summary(value: f64, mut draws: Vec<f64>, freedom: usize) -> Estimate {
    if draws.len() < 2 {
        let score = Score { value, low: value - 1.0, high: value + 1.0 };
        return Estimate { score, standard_error: f64::INFINITY, freedom: 0 };
    }
    draws.sort_by(f64::total_cmp);
    let mean = draws.iter().sum::<f64>() / draws.len() as f64;
    let variance = draws.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / (draws.len() - 1) as f64;
    let n = freedom as f64 + 1.0;
    let tail = expanded_tail(freedom);
    // A resampled interval of a skewed quantity may miss its own estimate: it is stretched to it.
    let low = quantile(&draws, tail).min(value);
    let high = quantile(&draws, 1.0 - tail).max(value);
    let standard_error = (variance * n / (n - 1.0)).sqrt();
    Estimate { score: Score { value, low, high }, standard_error, freedom }
}

/// Probability to cut from each end of the resampled values: below 2.5 %, because resampling n
/// clusters shrinks their variance by (n-1)/n and because a t-interval is wider than a normal one.
fn expanded_tail(freedom: usize) -> f64 {
    let tail = 0.5 * (1.0 - CONFIDENCE);
    let n = freedom as f64 + 1.0;
    let (Ok(t), Ok(normal)) = (StudentsT::new(0.0, 1.0, n - 1.0), Normal::new(0.0, 1.0)) else { return tail };
    normal.cdf((n / (n - 1.0)).sqrt() * t.inverse_cdf(tail))
}

/// Linear interpolation between the sorted values, probability 0 at the first and 1 at the last.
pub(crate) fn quantile(sorted: &[f64], probability: f64) -> f64 {
    let place = probability.clamp(0.0, 1.0) * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014), one stream per replicate.
pub(crate) struct Rng(u64);

impl Rng {
    pub(crate) fn new(seed: u64, stream: u64) -> Self {
        let mut rng = Self(seed ^ stream.wrapping_mul(0xd134_2543_de82_ef95));
        Self(rng.next())
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below `n`, every one as likely (to 2^-64 n).
    pub(crate) fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.next()) * n as u128) >> 64) as usize
    }
}
