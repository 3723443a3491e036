//! Triangles in eights, tested against a light together.

use super::eight::{Eight, LANES, bytes};
use super::frame::{Frame, Turn};
use super::lines::Ruling;
use super::outline::{BEYOND, Edge, MARGIN};
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

/// All lanes.
const ALL: u32 = (1 << LANES) - 1;

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
    /// The block that is not full yet, if there is one.
    begun: Option<usize>,
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
    /// Those that may be the receiver's own, in its plane or below its horizon.
    pub(crate) doubtful: u32,
}

/// A bit for each triangle of a block.
pub(crate) struct Face {
    /// Whether `behind` can be relied on.
    pub(crate) sure: u32,
    pub(crate) behind: u32,
    /// Surely above the receiver's horizon.
    pub(crate) clear: u32,
}

impl Blocks {
    pub(crate) fn clear(&mut self) {
        self.blocks.clear();
        self.boxes.clear();
        self.begun = None;
    }

    /// Returns the lane.
    pub(crate) fn push(&mut self, slot: u32, corners: &[Vec3; 3]) -> usize {
        let at = self.begun.unwrap_or_else(|| {
            let corners = corners.map(|c| c.to_array().map(Eight::all));
            self.blocks.push(Block { corners, slots: [slot; LANES], used: 0 });
            self.blocks.len() - 1
        });
        let block = &mut self.blocks[at];
        let lane = block.used.count_ones() as usize;
        for (into, corner) in block.corners.iter_mut().zip(corners) {
            for (into, c) in into.iter_mut().zip(corner.to_array()) {
                into.0[lane] = c;
            }
        }
        block.slots[lane] = slot;
        block.used |= 1 << lane;
        self.begun = (lane + 1 < LANES).then_some(at);
        lane
    }

    /// Some triangles of a block.
    #[inline(always)]
    pub(crate) fn push_some(&mut self, block: &Block, mut some: u32) {
        if some == ALL {
            self.blocks.push(*block);
            return;
        }
        while some != 0 {
            let lane = some.trailing_zeros() as usize;
            some &= some - 1;
            self.push(block.slots[lane], &block.triangle(lane));
        }
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
        // Twenty roundings of f32 are below 2e-6; the place and the centre have an ulp of their own.
        let ulps = Eight::all(1.2e-7 * frame.extent);
        let h = three!(axis => {
            let size = d[axis].abs() + boxes.half[axis];
            boxes.half[axis] + Eight::all(2e-6) * size + ulps
        });
        // Inside, Z is positive and as large as X and Y; the light ends before the last depth.
        let least = most(z - x, &d, &h).min(most(z + x, &d, &h));
        let least = least.min(most(z - y, &d, &h)).min(most(z + y, &d, &h)).min(most(z, &d, &h));
        let nearest = dot(z, &d) - dot(z.abs(), &h);
        let off = least.below(Eight::all(0.0));
        let near = nearest.below(Eight::all(frame.depth[1]));
        let [off, near, ..] = bytes([off, near, near, near]);
        let blocks = (self.blocks.len() - eight * LANES).min(LANES);
        !off & near & 0xff >> (LANES - blocks)
    }
}

impl Block {
    #[inline(always)]
    pub(crate) fn survey(&self, frame: &Frame) -> Survey {
        let zero = Eight::all(0.0);
        let [high, low] = frame.place;
        let m = frame.light_from_world.to_cols_array_2d();
        let [near, far] = frame.depth;
        let high = three!(axis => Eight::all(high[axis]));
        let low = three!(axis => Eight::all(low[axis]));
        let m = three!(column => three!(row => Eight::all(m[column][row])));
        let d = three!(i => three!(axis => (self.corners[i][axis] - high[axis]) - low[axis]));
        let [a, b, c] =
            three!(i => three!(row => m[0][row] * d[i][0] + m[1][row] * d[i][1] + m[2][row] * d[i][2]));
        // A corner surely above the horizon: f32 rounds eight times by 2^-24 of the coordinates.
        let clear = three!(i => {
            let [x, y, z] = d[i];
            let extent = Eight::all(frame.extent) + x.abs() + y.abs() + z.abs();
            dot(frame.normal, &d[i]) - Eight::all(2e-6) * extent
        });
        let clear = zero.below(clear[0].max(clear[1]).max(clear[2]));
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
        let volume = volume.signed_as(volume);
        let mut before = farthest.below(Eight::all(near));
        if frame.flat {
            // The same of the plane's depth: its least and largest excess over the light's.
            let [a, b, c] = three!(j => edges[0][j] + edges[1][j] + edges[2][j]);
            let reach = if frame.round { (a * a + b * b).sqrt() } else { a.abs() + b.abs() };
            let excess = c - volume * Eight::all(1.0 / near);
            largest = largest.min(excess + reach);
            before = before.or(zero.below(excess - reach));
        }
        let off = zero.below(outside).or(largest.below(zero));
        let front = zero.below(farthest).and(nearest.below(Eight::all(far))).and(zero.below(volume));
        let [some, before, partly, clear] =
            bytes([front.and(off.not()), before, smallest.below(zero), clear]);
        let some = some & self.used;
        let whole = some & before & !partly;
        Survey {
            edges,
            corners: [a, b, c],
            volume,
            some,
            whole,
            straddle: some & !before,
            doubtful: some & !clear,
        }
    }

    /// Corners as seen from a place.
    #[inline(always)]
    pub(crate) fn from(&self, place: Vec3) -> [[Eight; 3]; 3] {
        let place = place.to_array();
        three!(i => three!(axis => self.corners[i][axis] - Eight::all(place[axis])))
    }

    /// Which side of each triangle a receiver sees, as far as f32 can tell.
    #[inline(always)]
    pub(crate) fn face(&self, frame: &Frame) -> Face {
        let [high, low] = frame.place.map(|p| p.to_array());
        let [a, b, c] = three!(i => three!(axis => {
            (self.corners[i][axis] - Eight::all(high[axis])) - Eight::all(low[axis])
        }));
        let size = three!(axis => a[axis].abs().max(b[axis].abs()).max(c[axis].abs()));
        let rounding = Eight::all(2e-6) * (Eight::all(frame.extent) + size[0] + size[1] + size[2]);
        let n = frame.normal;
        let mut clear = rounding.below(dot(n, &a).max(dot(n, &b)).max(dot(n, &c)));
        if frame.in_air {
            clear = Eight::all(0.0).below(Eight::all(1.0));
        }
        let p = three!(axis => b[axis] - a[axis]);
        let q = three!(axis => c[axis] - a[axis]);
        let mut height = Eight::all(0.0);
        let mut off = Eight::all(0.0);
        for [i, j, k] in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            let (x, y) = (p[j] * q[k], p[k] * q[j]);
            height = height + (x - y) * a[i];
            off = off + (x.abs() + y.abs()) * a[i].abs();
        }
        // A dozen roundings of 2^-24 in each term.
        let sure = (off * Eight::all(1e-6) + Eight::all(f32::MIN_POSITIVE)).below(height.abs());
        let [clear, sure, behind, _] = bytes([clear, sure, height.below(Eight::all(0.0)), sure]);
        Face { sure, behind, clear }
    }

    /// Corner, axis.
    pub(crate) fn corners(&self) -> &[[Eight; 3]; 3] {
        &self.corners
    }

    #[inline(always)]
    pub(crate) fn corner(&self, lane: usize, corner: usize) -> Vec3 {
        let [x, y, z] = &self.corners[corner];
        Vec3::new(x.0[lane], y.0[lane], z.0[lane])
    }

    /// A bit for each triangle that there is.
    pub(crate) fn used(&self) -> u32 {
        self.used
    }

    #[inline(always)]
    pub(crate) fn triangle(&self, lane: usize) -> [Vec3; 3] {
        three!(corner => Vec3::from_array(three!(axis => self.corners[corner][axis].0[lane])))
    }
}

/// How the pictures of eight triangles lie on the rows.
pub(crate) struct Sides {
    /// Slope and place of the lines `x = slope y + at`: of an edge on the left, of one on the right,
    /// and of the third.
    pub(crate) slope: [Eight; 3],
    pub(crate) at: [Eight; 3],
    /// Beyond all rows on the right where the third is on the left, and the other way round.
    pub(crate) third: Eight,
    /// Rows that may be touched: the first, and the one after the last.
    pub(crate) rows: [[u32; LANES]; 2],
    /// A bit for each triangle all of whose edges are on one side: it reaches behind the receiver.
    pub(crate) open: u32,
}

impl Survey {
    /// The lines of the edges and the extent across the rows, of all eight.
    #[inline(always)]
    pub(crate) fn sides(&self, frame: &Frame, ruling: &Ruling, turn: &Turn) -> Sides {
        let zero = Eight::all(0.0);
        let lines = three!(i => {
            let [a, b, c] = self.edges[i];
            let x = a * Eight::all(turn.xx) + b * Eight::all(turn.yx);
            let y = a * Eight::all(turn.xy) + b * Eight::all(turn.yy);
            // An edge along the rows becomes one that all but is.
            let least = Eight::all(1e-12) * (y.abs() + c.abs()) + Eight::all(f32::MIN_POSITIVE);
            let x = x.abs().max(least).signed_as(x);
            let per = -(Eight::all(1.0) / x);
            ([y * per, c * per], zero.below(x))
        });
        let [([a, a_at], a_left), ([b, b_at], b_left), ([c, c_at], c_left)] = lines;
        let same = a_left.same(b_left);
        let slope = [a_left.pick(a, b_left.pick(b, c)), a_left.pick(b_left.pick(c, b), a), same.pick(b, c)];
        let at = [
            a_left.pick(a_at, b_left.pick(b_at, c_at)),
            a_left.pick(b_left.pick(c_at, b_at), a_at),
            same.pick(b_at, c_at),
        ];
        let beyond = Eight::all(BEYOND);
        let third = same.pick(b_left.pick(beyond, -beyond), c_left.pick(beyond, -beyond));
        let open = same.and(b_left.same(c_left)).bits();
        Sides { slope, at, third, rows: self.rows(frame, ruling, turn), open }
    }

    #[inline(always)]
    fn rows(&self, frame: &Frame, ruling: &Ruling, turn: &Turn) -> [[u32; LANES]; 2] {
        let [a, b, c] = three!(i => {
            let [x, y, z] = self.corners[i];
            [Eight::all(-turn.yx) * x + Eight::all(turn.yy) * y, z]
        });
        let (nearest, farthest) = (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]));
        let front = (farthest * Eight::all(1e-6)).below(nearest);
        let [a, b, c] = [a[0] / a[1], b[0] / b[1], c[0] / c[1]];
        let low = front.pick(a.min(b).min(c), Eight::all(-BEYOND));
        let high = front.pick(a.max(b).max(c), Eight::all(BEYOND));
        frame.rows(ruling, low, high)
    }

    /// `a x + b y + c` of the edges, not negative inside.
    pub(crate) fn edges(&self, lane: usize) -> [Edge; 3] {
        three!(i => {
            let [a, b, c] = &self.edges[i];
            Edge { a: a.0[lane], b: b.0[lane], c: c.0[lane] }
        })
    }

    /// The plane's own form, for a triangle that crosses a flat light at a depth: nearer than that.
    pub(crate) fn nearer(&self, lane: usize, depth: f32) -> Edge {
        let [a, b, c] =
            three!(i => self.edges[0][i].0[lane] + self.edges[1][i].0[lane] + self.edges[2][i].0[lane]);
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
pub(crate) fn edge(from: &[Eight; 3], to: &[Eight; 3]) -> [Eight; 3] {
    let s = three!(i => Eight::all(0.5) * (from[i] + to[i]));
    let d = three!(i => to[i] - from[i]);
    [s[1] * d[2] - s[2] * d[1], s[2] * d[0] - s[0] * d[2], s[0] * d[1] - s[1] * d[0]]
}
