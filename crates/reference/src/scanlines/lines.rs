//! The lines of samples across a light.
//!
//! A replicate is a lattice of rows: one random shift across all rows, one along them, and each row
//! stands further along than the one before by the replicate's step, a part of the distance between
//! two samples that is drawn near the golden section's, so that whatever runs across rows meets samples
//! evenly spread. Were the step the same for all, or the rows stratified, an edge across the rows
//! would meet the same number in nearly every replicate, and their spread say nothing. On a
//! rectangle the rows rise by [`RISE`] rows from side to side and wrap round, so that an edge
//! parallel to a side, the commonest of all, crosses rows everywhere. On a round light the rows have
//! a random direction and their ends are cut by the rim. Every sample is uniform on the light, hence
//! a count of hidden ones unbiased; on a round light the share divides by the samples inside, a
//! ratio whose bias falls with their number faster than its error (Cochran 1977, section 6.8).

use super::eight::{Eight, LANES};
use super::frame::{Frame, Turn};
use super::packets::Packet;
use crate::aim::Aim;
use crate::owen::{mix, unit};
use crate::samples::LightSamples;

/// Independent lattices, one in each lane; the first half of them is the first half of the truth.
pub(crate) const REPLICATES: usize = LANES;
/// Rows that a row rises by on a rectangle.
pub(crate) const RISE: usize = 2;
/// The least step from row to row along a row, in distances between samples, and by how much it
/// varies: about 1 minus the golden section's .618.
pub(crate) const STEP: [f32; 2] = [0.29, 0.14];
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
    pub(crate) y: Eight,
    /// On a cone, the cosine of the row's angle.
    pub(crate) cos: Eight,
    /// Sample i stands at `(i + shift) / per_row` of the way from -1 to 1 times the half width.
    pub(crate) shift: Eight,
    pub(crate) inside: [u32; REPLICATES],
    pub(crate) hidden: [u32; REPLICATES],
}

/// All rows of a receiver.
#[derive(Default)]
pub(crate) struct Lines {
    pub(crate) rows: Vec<Row>,
    pub(crate) per_row: f32,
}

impl Ruling {
    /// At least as many samples as asked for, of each replicate, up to 2048 and some more.
    pub(crate) fn new(samples: u32, round: bool) -> Self {
        // The square of a round light holds 4 / pi times its samples.
        let wanted = if round { f64::from(samples) * 4.0 / std::f64::consts::PI } else { f64::from(samples) };
        let mut rows = 4;
        // As many rows as samples in one, or up to twice: fewer would be faster, but 128 samples on
        // eight rows have 1.2 (rectangle) to 1.3 times (disk) the error of sixteen.
        let enough =
            |rows: usize| (rows * rows) as f64 * 1.3 >= wanted && (rows * BITS as usize) as f64 >= wanted;
        while rows < 128 && !enough(rows) {
            rows *= 2;
        }
        let per_row = ((wanted / rows as f64).ceil() as u32).clamp(1, BITS);
        Self { rows, per_row, round }
    }

    /// Rows without and with those that a rectangle's rise adds, and samples in each.
    pub(crate) fn size(&self) -> [u32; 3] {
        let extra = if self.round { 0 } else { RISE };
        [self.rows as u32, (self.rows + extra) as u32, self.per_row]
    }

    /// Of all replicates.
    pub(crate) fn samples(&self) -> usize {
        let square = self.rows * self.per_row as usize * REPLICATES;
        if self.round { (square as f64 * std::f64::consts::FRAC_PI_4).round() as usize } else { square }
    }

    /// How rows lie on the light: turned at random on a round one, rising or falling on a rectangle.
    pub(crate) fn turn(&self, seed: u64) -> Turn {
        let word = mix(seed ^ 0x7157);
        if self.round {
            let (sin, cos) = (unit(word as u32) * std::f32::consts::TAU).sin_cos();
            Turn { xx: cos, xy: -sin, yx: sin, yy: cos }
        } else {
            let rise = RISE as f32 / self.rows as f32;
            Turn { xx: 1.0, xy: 0.0, yx: if word & 1 == 0 { rise } else { -rise }, yy: 1.0 }
        }
    }

    /// Rows before the one at -1.
    #[inline(always)]
    pub(crate) fn before(&self) -> f32 {
        if self.round { 0.0 } else { 0.5 * RISE as f32 }
    }

    /// Draws all rows; nothing is hidden yet.
    #[inline(always)]
    pub(crate) fn fill(&self, lines: &mut Lines, frame: &Frame, turn: &Turn, seed: u64) {
        let extra = if self.round { 0 } else { RISE };
        let falls = turn.yx < 0.0;
        let (n, m) = (self.rows as f32, self.per_row as f32);
        lines.per_row = m;
        lines.rows.resize(self.rows + extra, Row::default());
        // Rows that rise start below the light, rows that fall end above it.
        let first = if self.round || falls { 0.0 } else { -(RISE as f32) };
        let middle = if self.round { 0.0 } else { 0.5 * RISE as f32 * if falls { -1.0 } else { 1.0 } };
        // Of each replicate: the shift across, the shift along, the step.
        let mut across = [0.0f32; REPLICATES];
        let mut along = [0.0f32; REPLICATES];
        let mut step = [0.0f32; REPLICATES];
        for k in 0..REPLICATES {
            let key = mix(seed.wrapping_add((k as u64 + 1) << 8));
            let (low, high) = (key as u32, (key >> 32) as u32);
            (across[k], along[k]) = (unit(low), unit(high));
            let rest = (low & 0xff) << 8 | high & 0xff;
            step[k] = STEP[0] + STEP[1] * (rest as f32 * (1.0 / 65536.0));
        }
        for (j, row) in lines.rows.iter_mut().enumerate() {
            let at = first + j as f32;
            // A row that leaves on one side comes back on the other: the same shift along it.
            let name = if falls || self.round { j } else { j + self.rows - RISE } % self.rows;
            row.hidden = [0; REPLICATES];
            for k in 0..REPLICATES {
                let shift = along[k] + name as f32 * step[k];
                row.shift.0[k] = shift - shift.floor();
                row.y.0[k] = 2.0 * (at + across[k] + middle) / n - 1.0;
            }
            if self.round {
                self.within(row, frame);
            } else {
                row.inside = self.wrapped(at, Eight(across), row.shift, falls);
            }
        }
    }

    /// The samples of a row that are on a rectangle. At the left side the row is at `whole` and a part;
    /// its other end has the same part, so that the two split their samples exactly.
    #[inline(always)]
    fn wrapped(&self, whole: f32, part: Eight, shift: Eight, falls: bool) -> [u32; REPLICATES] {
        let n = self.rows as f32;
        let all = u32::MAX >> (BITS - self.per_row);
        if whole >= RISE as f32 && whole < n - RISE as f32 {
            return [all; REPLICATES];
        }
        // The row only rises or only falls: where it crosses an end of the light, its samples part. One that
        // starts beyond an end enters, all others leave.
        let enters = if falls { whole >= n } else { whole < 0.0 };
        let end = Eight::all(if enters == falls { n - whole } else { -whole });
        let rise = Eight::all(if falls { -(RISE as f32) } else { RISE as f32 });
        let per_row = Eight::all(self.per_row as f32);
        // A closure might not be inlined, and then is compiled for narrow registers.
        macro_rules! before_end {
            ($i:expr) => {{
                let before = (part + rise * ($i + shift) / per_row).below(end);
                if falls { before.not() } else { before }
            }};
        }
        // As many samples as this are before it, one more or one less: two of them tell.
        let next = Eight(((end - part) * per_row / rise - shift).number().map(|number| number as f32));
        let (none, one) = (Eight::all(0.0), Eight::all(1.0));
        let last = next - one;
        let number = last + before_end!(last).pick(one, none) + before_end!(next).pick(one, none);
        let mut inside = number.before();
        for inside in &mut inside {
            *inside = if enters { !*inside } else { *inside } & all;
        }
        inside
    }

    /// The samples of a row that are on a round light.
    #[inline(always)]
    fn within(&self, row: &mut Row, frame: &Frame) {
        let mut reach = [0.0f32; REPLICATES];
        match frame.cone {
            Some(cone) => {
                for k in 0..REPLICATES {
                    [row.y.0[k], row.cos.0[k], reach[k]] = cone.row(row.y.0[k]);
                }
            }
            None => {
                for k in 0..REPLICATES {
                    reach[k] = 1.0 - row.y.0[k] * row.y.0[k];
                }
            }
        }
        let half = Eight::all(0.5 * self.per_row as f32);
        let wide = Eight(reach).max(Eight::all(0.0)).sqrt() * half;
        let centre = half - row.shift;
        let (to, from) = ((centre + wide).before(), (centre - wide).before());
        for k in 0..REPLICATES {
            row.inside[k] = to[k] & !from[k];
        }
    }
}

impl Lines {
    #[inline(always)]
    pub(crate) fn full(&self) -> bool {
        let mut open = [0u32; REPLICATES];
        for row in &self.rows {
            for k in 0..REPLICATES {
                open[k] |= row.inside[k] & !row.hidden[k];
            }
        }
        open.iter().all(|&bits| bits == 0)
    }

    /// Per replicate: the visible samples.
    #[inline(always)]
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
    #[inline(always)]
    pub(crate) fn inside(&self) -> [u32; REPLICATES] {
        let mut count = [0; REPLICATES];
        for row in &self.rows {
            for (count, inside) in count.iter_mut().zip(row.inside) {
                *count += inside.count_ones();
            }
        }
        count
    }

    /// Asks rays in eights for every sample that is not hidden yet.
    #[inline(always)]
    pub(super) fn trace_together(
        &mut self,
        (frame, turn, aim): (&Frame, &Turn, &Aim),
        (packet, open_nodes): (&mut Packet, &mut Vec<u32>),
        one: &mut LightSamples,
    ) {
        for row in &mut self.rows {
            for i in 0..BITS {
                let mut open = 0;
                for k in 0..REPLICATES {
                    open |= (row.inside[k] & !row.hidden[k]) >> i << k & 1 << k;
                }
                if open == 0 {
                    continue;
                }
                for k in 0..REPLICATES {
                    let along = 2.0 * (i as f32 + row.shift.0[k]) / self.per_row - 1.0;
                    one.set_place(aim, frame.place(turn, along, [row.y.0[k], row.cos.0[k]]));
                    packet.aim(k, aim, one);
                }
                let hidden = packet.blocked(open, open_nodes);
                for k in 0..REPLICATES {
                    row.hidden[k] |= (hidden >> k & 1) << i;
                }
            }
        }
    }

    /// Asks for every sample that is not hidden yet.
    pub(crate) fn trace(
        &mut self,
        (frame, turn, aim): (&Frame, &Turn, &Aim),
        one: &mut LightSamples,
        hidden: impl Fn(&LightSamples) -> bool,
    ) {
        for row in &mut self.rows {
            for k in 0..REPLICATES {
                let mut open = row.inside[k] & !row.hidden[k];
                while open != 0 {
                    let i = open.trailing_zeros();
                    open &= open - 1;
                    let along = 2.0 * (i as f32 + row.shift.0[k]) / self.per_row - 1.0;
                    let [x, y] = frame.place(turn, along, [row.y.0[k], row.cos.0[k]]);
                    one.set_place(aim, [x, y]);
                    if hidden(one) {
                        row.hidden[k] |= 1 << i;
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::receiver::Receiver;
    use glam::{DVec3, Vec3};
    use umbrage_scene::AreaLight;

    /// A row that leaves a rectangle comes back on its other side: each replicate has all of its samples, no more.
    #[test]
    fn rows_of_a_rectangle_wrap_round() {
        let receiver = Receiver::in_air(DVec3::ZERO);
        let light = AreaLight::Rect { centre: Vec3::Y * 3.0, half_u: Vec3::X, half_v: Vec3::Z };
        let aim = Aim::new(&light, &receiver).expect("a light");
        let frame = Frame::new(&receiver, &aim).expect("not edge-on");
        let mut lines = Lines::default();
        for samples in [1, 16, 100, 128, 256, 1000, 2048] {
            let ruling = Ruling::new(samples, false);
            let (mut rising, mut parted) = (0, 0);
            for seed in 0..500 {
                let turn = ruling.turn(seed);
                rising += u32::from(turn.yx > 0.0);
                ruling.fill(&mut lines, &frame, &turn, seed);
                let all = ruling.rows as u32 * ruling.per_row;
                assert_eq!(lines.inside(), [all; REPLICATES], "{samples} samples, seed {seed}");
                // And they are those that are on it; an ulp of a row's place may be in doubt.
                for (row, k) in lines.rows.iter().flat_map(|row| (0..REPLICATES).map(move |k| (row, k))) {
                    let inside = row.inside[k];
                    for i in 0..ruling.per_row {
                        let along = 2.0 * (i as f32 + row.shift.0[k]) / lines.per_row - 1.0;
                        let [x, y] = frame.place(&turn, along, [row.y.0[k], 0.0]);
                        let on = if inside >> i & 1 != 0 { y.abs() < 1.00001 } else { y.abs() > 0.99999 };
                        assert!(on && x.abs() <= 1.0, "{samples} samples, seed {seed}: {x} {y}");
                    }
                    parted += u32::from(inside != 0 && inside.count_ones() < ruling.per_row);
                }
            }
            assert!(rising > 150 && rising < 350, "{rising} of 500 rise");
            assert!(parted > 500 || ruling.per_row == 1, "{samples} samples: {parted} rows are parted");
        }
    }
}
