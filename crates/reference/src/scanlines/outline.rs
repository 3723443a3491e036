//! One triangle as seen on the light from one receiver, and the samples that it hides.
//!
//! With homogeneous edges (Olano and Greer 1997) corners behind the receiver need no clipping.

use super::blocks::Sides;
use super::eight::{Eight, LANES};
use super::frame::{Frame, Turn};
use super::lines::{Lines, Row};

/// Rounding of a place on the light, in half widths, that bounds are widened by: f32's 2^-24 times a
/// handful of operations.
pub(crate) const MARGIN: f32 = 1e-4;

/// Half widths that lie off every row, a wide cone's too.
pub(crate) const BEYOND: f32 = 1e4;

/// `a x + b y + c >= 0` inside.
#[derive(Clone, Copy, Default)]
pub(crate) struct Edge {
    pub(crate) a: f32,
    pub(crate) b: f32,
    pub(crate) c: f32,
}

/// `x` at `y` of a line: `slope y + at`.
type Side = [f32; 2];

/// What is to the right of all lows and to the left of all highs, on all rows.
pub(crate) struct Outline {
    low: [Side; 4],
    high: [Side; 4],
    lows: usize,
    highs: usize,
}

impl Outline {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self { low: [[0.0, -BEYOND]; 4], high: [[0.0, BEYOND]; 4], lows: 0, highs: 0 }
    }

    #[inline(always)]
    fn side(&mut self, sign: f32, line: Side) {
        if sign > 0.0 {
            self.low[self.lows] = line;
            self.lows += 1;
        } else {
            self.high[self.highs] = line;
            self.highs += 1;
        }
    }

    /// Adds an edge in the aim's coordinates.
    #[inline(always)]
    pub(crate) fn add(&mut self, turn: &Turn, Edge { a, b, c }: Edge) {
        let (x, y) = (a * turn.xx + b * turn.yx, a * turn.xy + b * turn.yy);
        // An edge along the rows becomes one that all but is.
        let x = x.abs().max(1e-12 * (y.abs() + c.abs()) + f32::MIN_POSITIVE).copysign(x);
        self.side(x, [-y / x, -c / x]);
    }

    /// Hides what is inside.
    #[inline(always)]
    pub(crate) fn cover(&self, lines: &mut Lines, frame: &Frame) {
        let per_row = lines.per_row;
        for row in &mut lines.rows {
            let mut from = at(row, self.low[0]).max(at(row, self.low[1]));
            let mut to = at(row, self.high[0]).min(at(row, self.high[1]));
            for i in 2..self.lows.max(self.highs) {
                from = from.max(at(row, self.low[i]));
                to = to.min(at(row, self.high[i]));
            }
            row.hide(frame, per_row, [from, to]);
        }
    }
}

/// Hides what is inside one of eight triangles.
#[inline(always)]
pub(crate) fn cover(sides: &Sides, lane: usize, lines: &mut Lines, frame: &Frame) {
    let last = (sides.rows[1][lane] as usize).min(lines.rows.len());
    let first = (sides.rows[0][lane] as usize).min(last);
    let per_row = lines.per_row;
    let third = Eight::all(sides.third.0[lane]);
    let (slope, place) = (&sides.slope, &sides.at);
    let a = [slope[0].0[lane], place[0].0[lane]];
    let b = [slope[1].0[lane], place[1].0[lane]];
    let c = [slope[2].0[lane], place[2].0[lane]];
    for row in &mut lines.rows[first..last] {
        let x = at(row, c);
        let from = at(row, a).max(x.min(third));
        let to = at(row, b).min(x.max(third));
        row.hide(frame, per_row, [from, to]);
    }
}

#[inline(always)]
fn at(row: &Row, [slope, at]: Side) -> Eight {
    Eight::all(slope) * row.y + Eight::all(at)
}

impl Row {
    /// Hides what is between two places of each replicate.
    #[inline(always)]
    fn hide(&mut self, frame: &Frame, per_row: f32, [mut from, mut to]: [Eight; 2]) {
        if let Some(cone) = &frame.cone {
            from = cone.along(from, self.cos);
            to = cone.along(to, self.cos);
        }
        let half = Eight::all(0.5 * per_row);
        let centre = half - self.shift;
        let from = (from * half + centre).before();
        let to = (to * half + centre).before();
        for k in 0..LANES {
            self.hidden[k] |= to[k] & !from[k];
        }
    }
}
