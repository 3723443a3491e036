//! The cells of the squared error for the page: maps by tile in one file, by pixel beside a page.
//!
//! Packed are roots with the sign of the estimate: squares of small numbers are below what a half float tells.

use crate::picture::round_up;
use crate::store::CELLS;
use std::collections::BTreeMap;
use umbrage_frame::Image;

/// What the page shows of the cells: each sum of cells that has a name, by the places of its parts in [`CELLS`].
const MAPS: [(&str, &[usize]); 8] = [
    ("mse", &[0, 1, 2, 3, 4]),
    ("banding", &[1, 3]),
    ("swimming", &[2, 3]),
    (CELLS[0], &[0]),
    (CELLS[1], &[1]),
    (CELLS[2], &[2]),
    (CELLS[3], &[3]),
    (CELLS[4], &[4]),
];

/// The highest value of each map in each variant of a window.
#[derive(Debug, Default)]
pub(super) struct Peaks(BTreeMap<(usize, &'static str), Vec<f32>>);

impl Peaks {
    /// Remembers how high the maps of a variant go.
    pub(super) fn add(&mut self, window: usize, cells: &[Image<f32>]) {
        for (id, parts) in MAPS {
            self.0.entry((window, id)).or_default().push(high(cells, parts));
        }
    }

    /// The ends of the maps' colours, the same for all variants of a window: the middle one of those that have any,
    /// for a hard shadow would leave the others dark. What lies beyond is clamped.
    pub(super) fn limits(self) -> BTreeMap<usize, BTreeMap<&'static str, f32>> {
        let mut limits: BTreeMap<usize, BTreeMap<&'static str, f32>> = BTreeMap::new();
        for ((window, id), peaks) in self.0 {
            let mut peaks: Vec<f32> = peaks.into_iter().filter(|p| *p > 0.0).collect();
            peaks.sort_by(f32::total_cmp);
            let limit = round_up(peaks.get(peaks.len() / 2).copied().unwrap_or(0.0)).min(1.0);
            limits.entry(window).or_default().insert(id, limit);
        }
        limits
    }
}

/// Root of the 99.5th percentile of a sum of cells, of which some may not have been measured.
fn high(cells: &[Image<f32>], parts: &[usize]) -> f32 {
    let Some(first) = cells.first() else { return 0.0 };
    let sum = |i: usize| {
        let values = parts.iter().map(|&p| cells[p].pixels()[i]).filter(|v| v.is_finite());
        values.fold(f32::NAN, |sum, v| if sum.is_nan() { v } else { sum + v })
    };
    let mut sums: Vec<f32> = (0..first.pixels().len()).map(sum).filter(|v| v.is_finite()).collect();
    sums.sort_by(f32::total_cmp);
    // Of a few tiles this is the largest.
    let place = (sums.len() * 995).div_ceil(1000).saturating_sub(1);
    sums.get(place).copied().unwrap_or(0.0).max(0.0).sqrt()
}

/// Roots with the sign of what they are roots of.
pub(super) fn roots(cells: &[Image<f32>]) -> Vec<Image<f32>> {
    cells.iter().map(|cell| cell.map(|v| v.signum() * v.abs().sqrt())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_end_where_the_middle_variant_does_and_nothing_has_a_range_too() {
        let cells = |noise: f32| -> Vec<Image<f32>> {
            (0..5).map(|c| Image::filled(3, 2, if c == 4 { noise } else { 0.0 })).collect()
        };
        let mut peaks = Peaks::default();
        [0.0, 1e-4, 4e-4, 1.0].into_iter().for_each(|noise| peaks.add(0, &cells(noise)));
        let limits = &peaks.limits()[&0];
        // Roots 0.01, 0.02 and 1: the middle one. Nothing bands: any range will do.
        assert_eq!([limits["noise"], limits["mse"], limits["banding"]], [0.02, 0.02, 1.0]);
    }

    #[test]
    fn roots_keep_signs_and_gaps() {
        let roots = roots(&[Image::from_pixels(3, 1, vec![4e-6, -9e-6, f32::NAN])]);
        let [a, b, c] = [0, 1, 2].map(|x| *roots[0].at(x, 0));
        assert!((a - 2e-3).abs() < 1e-9 && (b + 3e-3).abs() < 1e-9 && c.is_nan());
    }
}
