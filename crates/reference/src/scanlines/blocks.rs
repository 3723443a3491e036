//! Triangles in eights, tested against a light together.

use super::eight::{Eight, LANES};
use super::frame::{Frame, Turn};
use super::outline::{Edge, MARGIN};
use glam::Vec3;

/// An expression of 0, 1 and 2. Closures are not always inlined, and what is not inlined is compiled
/// for narrow registers.
macro_rules! three {
    ($i:ident => $value:expr) => {
        [
            {
                let $i = 0usize;
                $value
            },
            {
                let $i = 1usize;
                $value
            },
            {
                let $i = 2usize;
                $value
            },
        ]
    };
}

/// Eight triangles, or fewer: the last lanes repeat one.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    /// Corner, axis.
    corners: [[Eight; 3]; 3],
    pub(crate) slots: [u32; LANES],
    /// A bit for each triangle that there is.
    used: u32,
}

/// The boxes around eight blocks.
#[derive(Clone, Copy, Default)]
struct Boxes {
    centre: [Eight; 3],
    half: [Eight; 3],
}

/// Everything between a group of receivers and the light.
#[derive(Default)]
pub(crate) struct Blocks {
    pub(crate) blocks: Vec<Block>,
    boxes: Vec<Boxes>,
    filled: usize,
}

/// What eight triangles look like from one receiver.
pub(crate) struct Survey {
    /// Edge, coefficient.
    edges: [[Eight; 3]; 3],
    /// Corner, coordinate.
    corners: [[Eight; 3]; 3],
    volume: Eight,
    /// A bit for each triangle that may hide something, for those that hide everything, and for
    /// those that are not wholly nearer than the light.
    pub(crate) some: u32,
    pub(crate) whole: u32,
    pub(crate) straddle: u32,
}

impl Blocks {
    pub(crate) fn clear(&mut self) {
        self.blocks.clear();
        self.boxes.clear();
        self.filled = 0;
    }

    pub(crate) fn push(&mut self, slot: u32, corners: &[Vec3; 3]) {
        let lane = self.filled % LANES;
        if lane == 0 {
            let corners = corners.map(|c| c.to_array().map(Eight::all));
            self.blocks.push(Block { corners, slots: [slot; LANES], used: 0 });
        }
        if let Some(block) = self.blocks.last_mut() {
            for (into, corner) in block.corners.iter_mut().zip(corners) {
                for (into, c) in into.iter_mut().zip(corner.to_array()) {
                    into.0[lane] = c;
                }
            }
            block.slots[lane] = slot;
            block.used |= 1 << lane;
        }
        self.filled += 1;
    }

    /// Puts boxes around the blocks.
    #[inline(always)]
    pub(crate) fn close(&mut self) {
        for blocks in self.blocks.chunks(LANES) {
            let mut boxes = Boxes::default();
            for (lane, block) in blocks.iter().enumerate() {
                for axis in 0..3 {
                    let [a, b, c] = [block.corners[0][axis], block.corners[1][axis], block.corners[2][axis]];
                    let low = a.min(b).min(c).0.into_iter().fold(f32::INFINITY, f32::min);
                    let high = a.max(b).max(c).0.into_iter().fold(f32::NEG_INFINITY, f32::max);
                    boxes.centre[axis].0[lane] = 0.5 * (low + high);
                    boxes.half[axis].0[lane] = 0.5 * (high - low);
                }
            }
            self.boxes.push(boxes);
        }
    }

    /// Eights of blocks.
    pub(crate) fn eights(&self) -> usize {
        self.boxes.len()
    }

    /// A bit for each block of an eight whose box may hide a part of the light.
    #[inline(always)]
    pub(crate) fn between(&self, frame: &Frame, eight: usize) -> u32 {
        let boxes = &self.boxes[eight];
        let p = frame.place[0];
        let m = &frame.light_from_world;
        let (x, y, z) = (m.row(0), m.row(1), m.row(2));
        let d = three!(axis => boxes.centre[axis] - Eight::all(p[axis]));
        // Twenty roundings of f32 are below 2e-6.
        let h = three!(axis => boxes.half[axis] + Eight::all(2e-6) * (d[axis].abs() + boxes.half[axis]));
        // Inside, Z is positive and as large as X and Y; the light ends before the last depth.
        let least = most(z - x, &d, &h).min(most(z + x, &d, &h));
        let least = least.min(most(z - y, &d, &h)).min(most(z + y, &d, &h)).min(most(z, &d, &h));
        let nearest = dot(z, &d) - dot(z.abs(), &h);
        let off = least.below(Eight::all(0.0)).bits();
        let near = nearest.below(Eight::all(frame.depth[1])).bits();
        let blocks = (self.blocks.len() - eight * LANES).min(LANES);
        !off & near & 0xff >> (LANES - blocks)
    }
}

impl Block {
    #[inline(always)]
    pub(crate) fn survey(&self, frame: &Frame) -> Survey {
        let [high, low] = frame.place;
        let m = frame.light_from_world.to_cols_array_2d();
        let [near, far] = frame.depth;
        let high = three!(axis => Eight::all(high[axis]));
        let low = three!(axis => Eight::all(low[axis]));
        let m = three!(column => three!(row => Eight::all(m[column][row])));
        let [a, b, c] = three!(i => {
            let d = three!(axis => (self.corners[i][axis] - high[axis]) - low[axis]);
            three!(row => m[0][row] * d[0] + m[1][row] * d[1] + m[2][row] * d[2])
        });
        let nearest = a[2].min(b[2]).min(c[2]);
        let farthest = a[2].max(b[2]).max(c[2]);
        // Off the light on one side: X, -X, Y or -Y is larger than Z at every corner.
        let wide = Eight::all(1.0 + MARGIN);
        let reach = [a[2] * wide, b[2] * wide, c[2] * wide];
        let outside = three!(axis => {
            let beyond = (a[axis] - reach[0]).min(b[axis] - reach[1]).min(c[axis] - reach[2]);
            let before = (a[axis] + reach[0]).max(b[axis] + reach[1]).max(c[axis] + reach[2]);
            beyond.max(-before)
        });
        let outside = outside[0].max(outside[1]);
        let normals = [edge(&b, &c), edge(&c, &a), edge(&a, &b)];
        let volume = a[0] * normals[0][0] + a[1] * normals[0][1] + a[2] * normals[0][2];
        let edges = three!(i => three!(j => normals[i][j].signed_as(volume)));
        // An edge's least and largest value on the light.
        let mut smallest = Eight::all(f32::INFINITY);
        let mut largest = Eight::all(f32::INFINITY);
        for [a, b, c] in &edges {
            let reach = if frame.round { (*a * *a + *b * *b).sqrt() } else { a.abs() + b.abs() };
            smallest = smallest.min(*c - reach);
            largest = largest.min(*c + reach);
        }
        let zero = Eight::all(0.0);
        let volume = volume.signed_as(volume);
        let none = zero.below(outside).bits() | largest.below(zero).bits();
        let front = zero.below(farthest).and(nearest.below(Eight::all(far))).and(zero.below(volume)).bits();
        let some = front & !none & self.used;
        let straddle = !farthest.below(Eight::all(near)).bits();
        let whole = some & !straddle & !smallest.below(zero).bits();
        Survey { edges, corners: [a, b, c], volume, some, whole, straddle }
    }

    #[inline(always)]
    pub(crate) fn triangle(&self, lane: usize) -> [Vec3; 3] {
        three!(corner => Vec3::from_array(three!(axis => self.corners[corner][axis].0[lane])))
    }
}

/// How the pictures of eight triangles lie on the rows.
pub(crate) struct Sides {
    /// Of each edge: slope and place of its line `x = slope y + at`, and the sign of its x.
    pub(crate) slope: [Eight; 3],
    pub(crate) at: [Eight; 3],
    pub(crate) sign: [Eight; 3],
    /// The least and the largest place across the rows; all of them for a triangle that reaches
    /// behind the receiver.
    pub(crate) low: Eight,
    pub(crate) high: Eight,
}

impl Survey {
    /// The lines of the edges and the extent across the rows, of all eight.
    #[inline(always)]
    pub(crate) fn sides(&self, turn: &Turn) -> Sides {
        let [p, q, r] = three!(i => {
            let [a, b, c] = self.edges[i];
            let x = a * Eight::all(turn.xx) + b * Eight::all(turn.yx);
            let y = a * Eight::all(turn.xy) + b * Eight::all(turn.yy);
            // An edge along the rows becomes one that all but is.
            let least = Eight::all(1e-12) * (y.abs() + c.abs()) + Eight::all(f32::MIN_POSITIVE);
            let x = x.abs().max(least).signed_as(x);
            let per = -(Eight::all(1.0) / x);
            [y * per, c * per, x]
        });
        let [a, b, c] = three!(i => {
            let [x, y, z] = self.corners[i];
            [Eight::all(-turn.yx) * x + Eight::all(turn.yy) * y, z]
        });
        let (nearest, farthest) = (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]));
        let [a, b, c] = [a[0] / a[1], b[0] / b[1], c[0] / c[1]];
        let (mut low, mut high) = (a.min(b).min(c), a.max(b).max(c));
        let behind = !(farthest * Eight::all(1e-6)).below(nearest).bits();
        for k in 0..LANES {
            low.0[k] = if behind >> k & 1 != 0 { -1e3 } else { low.0[k] };
            high.0[k] = if behind >> k & 1 != 0 { 1e3 } else { high.0[k] };
        }
        Sides { slope: [p[0], q[0], r[0]], at: [p[1], q[1], r[1]], sign: [p[2], q[2], r[2]], low, high }
    }

    /// The plane's own form, for a triangle that crosses a flat light at a depth: nearer than that.
    pub(crate) fn nearer(&self, lane: usize, depth: f32) -> Edge {
        let [a, b, c] = three!(i => self.edges[0][i].0[lane] + self.edges[1][i].0[lane] + self.edges[2][i].0[lane]);
        Edge { a, b, c: c - self.volume.0[lane] / depth }
    }
}

#[inline(always)]
fn dot(n: Vec3, v: &[Eight; 3]) -> Eight {
    Eight::all(n.x) * v[0] + Eight::all(n.y) * v[1] + Eight::all(n.z) * v[2]
}

/// The largest height of a box over a plane through the receiver.
#[inline(always)]
fn most(n: Vec3, centre: &[Eight; 3], half: &[Eight; 3]) -> Eight {
    dot(n, centre) + dot(n.abs(), half)
}

/// The cross product of sum and difference, halved: `from x to`, but it negates exactly when the
/// ends change places. Nothing leaks between neighbours.
#[inline(always)]
fn edge(from: &[Eight; 3], to: &[Eight; 3]) -> [Eight; 3] {
    let s = three!(i => Eight::all(0.5) * (from[i] + to[i]));
    let d = three!(i => to[i] - from[i]);
    [s[1] * d[2] - s[2] * d[1], s[2] * d[0] - s[0] * d[2], s[0] * d[1] - s[1] * d[0]]
}

