//! One triangle as seen on the light from one receiver.
//!
//! With homogeneous edges (Olano and Greer 1997) corners behind the receiver need no clipping.

use super::frame::{Frame, Turn};
use super::lines::{Lines, REPLICATES, Ruling};

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

/// What is inside all edges, on some rows.
#[derive(Clone, Copy)]
pub(crate) struct Outline {
    edges: [Edge; 4],
    count: usize,
    rows: [usize; 2],
}

/// `x` at `y` of a line: `slope y + at`.
type Side = [f32; 2];

impl Outline {
    pub(crate) const ALL_ROWS: [usize; 2] = [0, usize::MAX];

    pub(crate) fn new(rows: [usize; 2]) -> Self {
        Self { edges: [Edge::default(); 4], count: 0, rows }
    }

    /// Adds an edge in the aim's coordinates.
    #[inline(always)]
    pub(crate) fn add(&mut self, turn: &Turn, Edge { a, b, c }: Edge) {
        let edge = Edge { a: a * turn.xx + b * turn.yx, b: a * turn.xy + b * turn.yy, c };
        self.edges[self.count] = edge;
        self.count += 1;
    }

    /// Hides what is inside.
    #[inline(always)]
    pub(crate) fn cover(&self, lines: &mut Lines, frame: &Frame) {
        let mut low: [Side; 4] = [[0.0, -BEYOND]; 4];
        let mut high: [Side; 4] = [[0.0, BEYOND]; 4];
        let (mut lows, mut highs) = (0, 0);
        for edge in &self.edges[..self.count] {
            // An edge along the rows becomes one that all but is.
            let least = 1e-12 * (edge.b.abs() + edge.c.abs());
            let a = if edge.a.abs() > least { edge.a } else { least.max(f32::MIN_POSITIVE) };
            let line = [-edge.b / a, -edge.c / a];
            if a > 0.0 {
                low[lows] = line;
                lows += 1;
            } else {
                high[highs] = line;
                highs += 1;
            }
        }
        let count = lines.rows.len();
        let range = self.rows[0].min(count)..self.rows[1].min(count);
        let (half, centre) = (0.5 * lines.per_row, 0.5 * lines.per_row);
        let crowded = lows.max(highs) > 2;
        for row in &mut lines.rows[range] {
            let mut from = [0.0f32; REPLICATES];
            let mut to = [0.0f32; REPLICATES];
            for k in 0..REPLICATES {
                from[k] = larger(low[0][0] * row.y[k] + low[0][1], low[1][0] * row.y[k] + low[1][1]);
                to[k] = smaller(high[0][0] * row.y[k] + high[0][1], high[1][0] * row.y[k] + high[1][1]);
            }
            if crowded {
                for k in 0..REPLICATES {
                    for side in &low[2..] {
                        from[k] = larger(from[k], side[0] * row.y[k] + side[1]);
                    }
                    for side in &high[2..] {
                        to[k] = smaller(to[k], side[0] * row.y[k] + side[1]);
                    }
                }
            }
            if let Some(cone) = frame.cone {
                for k in 0..REPLICATES {
                    from[k] = cone.along(from[k], row.cos[k]);
                    to[k] = cone.along(to[k], row.cos[k]);
                }
            }
            for k in 0..REPLICATES {
                let from = below(from[k] * half + (centre - row.shift[k]));
                let to = below(to[k] * half + (centre - row.shift[k]));
                row.hidden[k] |= to & !from;
            }
        }
    }
}

#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The samples before a place: those whose number is less.
#[inline(always)]
pub(super) fn below(place: f32) -> u32 {
    let place = smaller(larger(place, 0.0), 32.0).ceil();
    // The sum's lowest bits are the number.
    let number = (place + 8_388_608.0).to_bits() & 0x3f;
    1u32.unbounded_shl(number).wrapping_sub(1)
}

/// Rows that a picture between two places across them may touch.
#[inline(always)]
pub(crate) fn rows_between(frame: &Frame, ruling: &Ruling, places: [f32; 2]) -> [usize; 2] {
    let [low, high] = match frame.cone {
        None => places,
        Some(cone) => cone.angles(places),
    };
    let half = 0.5 * ruling.rows as f32;
    // Row j of a replicate stands between j and j + 1.
    let row = |y: f32| (y + 1.0) * half + ruling.before();
    let first = larger(row(low) - 1.0 - MARGIN * half, 0.0) as usize;
    let last = larger(row(high) + MARGIN * half + 1.0, 0.0) as usize;
    [first, last]
}
