//! Whether a profile across the penumbra is a staircase.
//!
//! In each tile the penumbra points are sorted by the true visibility and averaged in bins of equal
//! count; `d` are the increments of the variant's mean from bin to bin. A staircase puts its rise
//! into few increments: exp of their Renyi entropy of order 2 is `(sum d)^2 / sum d^2`. A jump inside
//! a bin splits into two increments; `sum (d_i^2 + 2 d_i d_(i+1))` puts them together again, exactly
//! for jumps that are apart. Squares are products of two halves of the seeds, so that noise, which
//! the halves do not share, adds nothing.

use crate::{MetricsError, Panel, PanelTruth, Tile, Tiling};

/// At least so many points in a bin (fewer tell more levels apart, but the noise of the sums of
/// products grows with the power -2.5), and so many bins in a profile.
const POINTS_PER_BIN: usize = 6;
const FEWEST_BINS: usize = 12;
const MOST_BINS: usize = 192;

/// Sums of a tile: for the variant, then for the truth, [rise, squared rise per bin, sum of steps,
/// sum of squared increments].
pub(crate) const STAIRS: usize = 8;

/// Visibility at each point, mean over the frames of each half of the seeds (the same twice where
/// there is one seed).
pub(crate) struct SeedMeans {
    halves: [Vec<f64>; 2],
}

impl SeedMeans {
    pub(crate) fn new(panel: &Panel, tiling: &Tiling) -> Result<Self, MetricsError> {
        let mut sums = [vec![0.0; panel.points], vec![0.0; panel.points]];
        let mut counts = [0.0; 2];
        for frame in 0..panel.frames {
            for seed in 0..panel.seeds {
                let start = (frame * panel.seeds + seed) * panel.points;
                let half = seed % 2;
                counts[half] += 1.0;
                let values = &panel.values[start..start + panel.points];
                sums[half].iter_mut().zip(values).for_each(|(s, &v)| *s += f64::from(v));
            }
        }
        if panel.seeds == 1 {
            sums[1] = sums[0].clone();
            counts[1] = counts[0];
        }
        for (sums, count) in sums.iter_mut().zip(counts) {
            sums.iter_mut().for_each(|s| *s /= count);
        }
        let means = Self { halves: sums };
        for point in tiling.tiles.iter().flat_map(Tile::points) {
            if !means.all(point).is_finite() {
                let point = point as usize;
                return Err(MetricsError::NotFinite { what: "the variant", frame: 0, seed: 0, point });
            }
        }
        Ok(means)
    }

    pub(crate) fn all(&self, point: u32) -> f64 {
        0.5 * (self.halves[0][point as usize] + self.halves[1][point as usize])
    }
}

/// The sums of one tile; zeros where it has too few points.
pub(crate) fn stairs(tile: &Tile, truth: &PanelTruth, means: &SeedMeans) -> [f64; STAIRS] {
    let g = |p: u32| f64::from(truth.basis[p as usize]);
    let mut sorted: Vec<u32> = tile.penumbra.iter().copied().filter(|&p| g(p) > 0.0 && g(p) < 1.0).collect();
    let bins = (sorted.len() / POINTS_PER_BIN).min(MOST_BINS);
    if bins < FEWEST_BINS {
        return [0.0; STAIRS];
    }
    sorted.sort_by(|&a, &b| g(a).total_cmp(&g(b)));
    let increments = |of: &dyn Fn(u32) -> f64| -> Vec<f64> {
        let mean = |bin: usize| {
            let points = &sorted[bin * sorted.len() / bins..(bin + 1) * sorted.len() / bins];
            points.iter().map(|&p| of(p)).sum::<f64>() / points.len() as f64
        };
        let means: Vec<f64> = (0..bins).map(mean).collect();
        means.windows(2).map(|pair| pair[1] - pair[0]).collect()
    };
    let [a, b] = [0, 1].map(|half: usize| increments(&|p| means.halves[half][p as usize]));
    let true_rise = increments(&g);
    let mut sums = [0.0; STAIRS];
    sums[..4].copy_from_slice(&moments(&a, &b));
    sums[4..].copy_from_slice(&moments(&true_rise, &true_rise));
    sums
}

fn moments(a: &[f64], b: &[f64]) -> [f64; 4] {
    let [rise_a, rise_b] = [a, b].map(|d| d.iter().sum::<f64>());
    let squares: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let neighbours: f64 = a.windows(2).zip(b.windows(2)).map(|(a, b)| a[0] * b[1] + a[1] * b[0]).sum();
    [0.5 * (rise_a + rise_b), rise_a * rise_b / a.len() as f64, squares + neighbours, squares]
}
