//! The lines of samples across a light.
//!
//! A replicate is a lattice of rows: one common shift across the rows, one shift along each. On a
//! rectangle the rows rise by [`RISE`] rows from side to side and wrap round, so that an edge
//! parallel to a side, the commonest of all, crosses rows everywhere. On a round light the rows have
//! a random direction and their ends are cut by the rim. Every sample is uniform on the light, hence
//! a count of hidden ones unbiased; on a round light the share divides by the samples inside, a
//! ratio whose bias is below 1e-4 at 1024 samples and falls with their number.

use super::outline::Frame;
use crate::aim::Aim;
use crate::owen::{mix, unit};
use crate::samples::LightSamples;

/// Independent lattices, one in each lane; the first half of them is the first half of the truth.
pub(crate) const REPLICATES: usize = 8;
/// Rows that a row rises by on a rectangle.
pub(crate) const RISE: usize = 2;
/// Samples that fit in the mask of a row.
const BITS: u32 = 32;

/// Rows and samples of one replicate.
#[derive(Clone, Copy)]
pub(crate) struct Ruling {
    pub(crate) rows: usize,
    per_row: u32,
    round: bool,
}

/// One row of all replicates.
#[derive(Clone, Copy, Default)]
pub(crate) struct Row {
    /// Across the rows, in the frame's coordinate.
    pub(crate) y: [f32; REPLICATES],
    /// On a cone, 1 + y^2.
    pub(crate) q2: [f32; REPLICATES],
    /// Sample i stands at `(i + shift) / per_row` of the way from -1 to 1 times the half width.
    pub(crate) shift: [f32; REPLICATES],
    inside: [u32; REPLICATES],
    pub(crate) hidden: [u32; REPLICATES],
}

/// All rows of a receiver.
#[derive(Default)]
pub(crate) struct Lines {
    pub(crate) rows: Vec<Row>,
    pub(crate) per_row: f32,
}

impl Ruling {
    /// At least as many samples as asked for, of each replicate, up to 2048.
    pub(crate) fn new(samples: u32, round: bool) -> Self {
        // The square of a round light holds 4 / pi times its samples.
        let wanted = if round { f64::from(samples) * 4.0 / std::f64::consts::PI } else { f64::from(samples) };
        let mut rows = 4;
        let enough = |rows: usize| (2 * rows * rows) as f64 * 1.3 >= wanted && (rows * BITS as usize) as f64 >= wanted;
        while rows < 128 && !enough(rows) {
            rows *= 2;
        }
        let per_row = ((wanted / rows as f64).ceil() as u32).clamp(1, BITS);
        Self { rows, per_row, round }
    }

    /// Of all replicates.
    pub(crate) fn samples(&self) -> usize {
        let square = self.rows * self.per_row as usize * REPLICATES;
        if self.round { (square as f64 * std::f64::consts::FRAC_PI_4).round() as usize } else { square }
    }

    /// How the frame is turned: sine and cosine on a round light, the shear on a rectangle.
    pub(crate) fn tilt(&self, seed: u64) -> [f64; 2] {
        let word = mix(seed ^ 0x7157);
        if self.round {
            let (sin, cos) = (f64::from(unit(word as u32)) * std::f64::consts::TAU).sin_cos();
            [cos, sin]
        } else {
            [if word & 1 == 0 { 1.0 } else { -1.0 } * RISE as f64 / self.rows as f64, 0.0]
        }
    }

    /// Draws all rows; nothing is hidden yet.
    pub(crate) fn fill(&self, lines: &mut Lines, frame: &Frame, seed: u64) {
        let extra = if self.round { 0 } else { RISE };
        lines.rows.clear();
        lines.rows.resize(self.rows + extra, Row::default());
        let (n, m) = (self.rows as f32, self.per_row as f32);
        lines.per_row = m;
        let falls = frame.shear < 0.0;
        // Rows that rise start below the light, rows that fall end above it.
        let first = if self.round || falls { 0.0 } else { -(extra as f32) };
        let offset = if self.round { 0.0 } else { (RISE as f32) * if falls { -1.0 } else { 1.0 } };
        let place = |row: f32, common: f32| 2.0 * (row + common + 0.5 * offset) / n - 1.0;
        for lane in 0..REPLICATES {
            let key = mix(seed.wrapping_add((lane as u64 + 1) << 8));
            let common = unit(key as u32);
            for (j, row) in lines.rows.iter_mut().enumerate() {
                let at = first + j as f32;
                // A row that leaves on one side comes back on the other: the same shift along it.
                let name = (j + self.rows - extra.min(j + self.rows)) % self.rows;
                let name = if falls { j % self.rows } else { name };
                row.shift[lane] = unit(mix(key ^ (name as u64) << 32) as u32);
                let y = place(at, common);
                row.inside[lane] = if self.round {
                    self.within(frame, y, row.shift[lane])
                } else {
                    self.wrapped([at, common], row.shift[lane], falls)
                };
                (row.y[lane], row.q2[lane]) = frame.row(y);
            }
        }
    }

    /// The samples of a row that are on a rectangle. At the left side the row is at `whole + part`;
    /// its other end has the same part, so that the two split their samples exactly.
    fn wrapped(&self, [whole, part]: [f32; 2], shift: f32, falls: bool) -> u32 {
        let n = self.rows as f32;
        let sign = if falls { -1.0 } else { 1.0 };
        if whole >= RISE as f32 && whole < n - RISE as f32 {
            return u32::MAX >> (BITS - self.per_row);
        }
        (0..self.per_row).fold(0, |bits, i| {
            let rise = part + sign * RISE as f32 * (i as f32 + shift) / self.per_row as f32;
            let strip = whole + rise.floor();
            bits | u32::from(strip >= 0.0 && strip < n) << i
        })
    }

    /// The samples of a row that are on a round light.
    fn within(&self, frame: &Frame, y: f32, shift: f32) -> u32 {
        let reach = frame.chord(y);
        (0..self.per_row).fold(0, |bits, i| {
            let x = 2.0 * (i as f32 + shift) / self.per_row as f32 - 1.0;
            bits | u32::from(x * x < reach) << i
        })
    }
}

impl Lines {
    pub(crate) fn full(&self) -> bool {
        self.rows.iter().all(|row| {
            (0..REPLICATES).fold(0, |open, k| open | (row.inside[k] & !row.hidden[k])) == 0
        })
    }

    /// Per replicate: the visible samples.
    pub(crate) fn visible(&self) -> [u32; REPLICATES] {
        let mut count = [0; REPLICATES];
        for row in &self.rows {
            for (k, count) in count.iter_mut().enumerate() {
                *count += (row.inside[k] & !row.hidden[k]).count_ones();
            }
        }
        count
    }

    /// Per replicate: the samples on the light.
    pub(crate) fn inside(&self) -> [u32; REPLICATES] {
        let mut count = [0; REPLICATES];
        for row in &self.rows {
            for (count, inside) in count.iter_mut().zip(row.inside) {
                *count += inside.count_ones();
            }
        }
        count
    }

    /// Asks for every sample that is not hidden yet.
    pub(crate) fn trace(
        &mut self,
        frame: &Frame,
        aim: &Aim,
        one: &mut LightSamples,
        hidden: impl Fn(&LightSamples) -> bool,
    ) {
        for row in &mut self.rows {
            for k in 0..REPLICATES {
                let mut open = row.inside[k] & !row.hidden[k];
                while open != 0 {
                    let i = open.trailing_zeros();
                    open &= open - 1;
                    let along = 2.0 * (i as f32 + row.shift[k]) / self.per_row - 1.0;
                    let [x, y] = frame.place(along, row.y[k], row.q2[k]);
                    one.set_place(aim, [x, y]);
                    if hidden(one) {
                        row.hidden[k] |= 1 << i;
                    }
                }
            }
        }
    }
}
