//! One triangle as seen on the light from one receiver, and the samples that it hides.
//!
//! With homogeneous edges (Olano and Greer 1997) corners behind the receiver need no clipping.

use super::blocks::Sides;
use super::eight::Eight;
use super::frame::{Frame, Turn};
use super::lines::{Lines, Row, Ruling};

/// Rounding of a place on the light, in half widths, that bounds are widened by: f32's 2^-24 times a
/// handful of operations.
pub(super) const MARGIN: f32 = 1e-4;

/// Half widths that lie off every row, a wide cone's too.
const BEYOND: f32 = 1e4;

/// `a x + b y + c >= 0` inside.
#[derive(Clone, Copy, Default)]
pub(crate) struct Edge {
    pub(crate) a: f32,
    pub(crate) b: f32,
    pub(crate) c: f32,
}

/// `x` at `y` of a line: `slope y + at`.
type Side = [f32; 2];

/// What is to the right of all lows and to the left of all highs, on some rows.
pub(crate) struct Outline {
    low: [Side; 4],
    high: [Side; 4],
    lows: usize,
    highs: usize,
    rows: [usize; 2],
}

impl Outline {
    pub(crate) const ALL_ROWS: [usize; 2] = [0, usize::MAX];

    #[inline(always)]
    pub(crate) fn new(rows: [usize; 2]) -> Self {
        Self { low: [[0.0, -BEYOND]; 4], high: [[0.0, BEYOND]; 4], lows: 0, highs: 0, rows }
    }

    /// One of eight triangles.
    #[inline(always)]
    pub(crate) fn triangle(sides: &Sides, lane: usize, rows: [usize; 2]) -> Self {
        let mut outline = Self::new(rows);
        for i in 0..3 {
            outline.side(sides.sign[i].0[lane], [sides.slope[i].0[lane], sides.at[i].0[lane]]);
        }
        outline
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
    pub(crate) fn add(&mut self, turn: &Turn, Edge { a, b, c }: Edge) {
        let (x, y) = (a * turn.xx + b * turn.yx, a * turn.xy + b * turn.yy);
        // An edge along the rows becomes one that all but is.
        let x = x.abs().max(1e-12 * (y.abs() + c.abs()) + f32::MIN_POSITIVE).copysign(x);
        self.side(x, [-y / x, -c / x]);
    }

    /// Hides what is inside.
    #[inline(always)]
    pub(crate) fn cover(&self, lines: &mut Lines, frame: &Frame) {
        let count = lines.rows.len();
        let range = self.rows[0].min(count)..self.rows[1].min(count);
        let half = Eight::all(0.5 * lines.per_row);
        let crowded = self.lows.max(self.highs) > 2;
        for row in &mut lines.rows[range] {
            let mut from = at(row, self.low[0]).max(at(row, self.low[1]));
            let mut to = at(row, self.high[0]).min(at(row, self.high[1]));
            if crowded {
                from = from.max(at(row, self.low[2])).max(at(row, self.low[3]));
                to = to.min(at(row, self.high[2])).min(at(row, self.high[3]));
            }
            if let Some(cone) = &frame.cone {
                from = cone.along(from, row.cos);
                to = cone.along(to, row.cos);
            }
            let centre = half - row.shift;
            let from = (from * half + centre).before();
            let to = (to * half + centre).before();
            for ((hidden, from), to) in row.hidden.iter_mut().zip(from).zip(to) {
                *hidden |= to & !from;
            }
        }
    }
}

#[inline(always)]
fn at(row: &Row, [slope, at]: Side) -> Eight {
    Eight::all(slope) * row.y + Eight::all(at)
}

/// Rows that a picture between two places across them may touch.
#[inline(always)]
pub(crate) fn rows_between(frame: &Frame, ruling: &Ruling, places: [f32; 2]) -> [usize; 2] {
    let [low, high] = match &frame.cone {
        None => places,
        Some(cone) => cone.angles(places),
    };
    let half = 0.5 * ruling.rows as f32;
    // Row j of a replicate stands between j and j + 1.
    let middle = half + ruling.before();
    let first = (low * half + (middle - 1.0 - MARGIN * half)).clamp(0.0, 1e3) as i32;
    let last = (high * half + (middle + 1.0 + MARGIN * half)).clamp(0.0, 1e3) as i32;
    [first as usize, last as usize]
}
