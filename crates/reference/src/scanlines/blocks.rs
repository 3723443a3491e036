//! Triangles in eights, tested against a light together.
//!
//! Plain loops over eight lanes, inlined into a function that is compiled for wide registers.

use super::frame::Frame;
use super::outline::{Edge, MARGIN};
use glam::Vec3;

pub(crate) const LANES: usize = 8;
type Lanes = [f32; LANES];

/// Eight triangles, or fewer.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    /// Corner, axis, lane.
    corners: [[Lanes; 3]; 3],
    pub(crate) slots: [u32; LANES],
    /// A bit for each triangle that there is.
    used: u32,
}

/// The boxes around eight blocks.
#[derive(Clone, Copy)]
struct Boxes {
    centre: [Lanes; 3],
    half: [Lanes; 3],
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
    /// Edge, coefficient, lane.
    edges: [[Lanes; 3]; 3],
    /// Corner, coordinate, lane.
    corners: [[Lanes; 3]; 3],
    volume: Lanes,
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
            let corners = corners.map(|c| c.to_array().map(|c| [c; LANES]));
            self.blocks.push(Block { corners, slots: [slot; LANES], used: 0 });
        }
        if let Some(block) = self.blocks.last_mut() {
            for (into, corner) in block.corners.iter_mut().zip(corners) {
                for (into, c) in into.iter_mut().zip(corner.to_array()) {
                    into[lane] = c;
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
            let mut boxes = Boxes { centre: [[0.0; LANES]; 3], half: [[0.0; LANES]; 3] };
            for (lane, block) in blocks.iter().enumerate() {
                for axis in 0..3 {
                    let [mut low, mut high] = [block.corners[0][axis]; 2];
                    for corner in &block.corners[1..] {
                        for k in 0..LANES {
                            low[k] = low[k].min(corner[axis][k]);
                            high[k] = high[k].max(corner[axis][k]);
                        }
                    }
                    let low = low.into_iter().fold(f32::INFINITY, f32::min);
                    let high = high.into_iter().fold(f32::NEG_INFINITY, f32::max);
                    boxes.centre[axis][lane] = 0.5 * (low + high);
                    boxes.half[axis][lane] = 0.5 * (high - low);
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
        // Inside, Z is positive and as large as X and Y; the light ends before the last depth.
        let planes = [z - x, z + x, z - y, z + y, z];
        let depth = frame.depth[1];
        let mut out = [0u32; LANES];
        for (k, out) in out.iter_mut().enumerate() {
            let d = [0, 1, 2].map(|axis| boxes.centre[axis][k] - p[axis]);
            // Twenty roundings of f32 are below 2e-6.
            let h = [0, 1, 2].map(|axis| boxes.half[axis][k] + 2e-6 * (d[axis].abs() + boxes.half[axis][k]));
            let reach = |n: Vec3| n.x.abs() * h[0] + n.y.abs() * h[1] + n.z.abs() * h[2];
            let at = |n: Vec3| n.x * d[0] + n.y * d[1] + n.z * d[2];
            let mut least = f32::INFINITY;
            for n in planes {
                let most = at(n) + reach(n);
                least = if most < least { most } else { least };
            }
            let near = at(z) - reach(z) < depth;
            *out = u32::from(least >= 0.0) & u32::from(near);
        }
        let bits = bits(&out, 1);
        let blocks = (self.blocks.len() - eight * LANES).min(LANES);
        bits & 0xff >> (LANES - blocks)
    }
}

const SOME: u32 = 1;
const WHOLE: u32 = 2;
const STRADDLE: u32 = 4;

impl Block {
    #[inline(always)]
    pub(crate) fn survey(&self, frame: &Frame) -> Survey {
        let [high, low] = frame.place;
        let m = &frame.light_from_world;
        let [near, far] = frame.depth;
        let mut survey = Survey {
            edges: [[[0.0; LANES]; 3]; 3],
            corners: [[[0.0; LANES]; 3]; 3],
            volume: [0.0; LANES],
            some: 0,
            whole: 0,
            straddle: 0,
        };
        let mut flags = [0u32; LANES];
        let wide = 1.0 + MARGIN;
        for k in 0..LANES {
            let corner = |i: usize| {
                let [x, y, z] = [0, 1, 2].map(|axis| (self.corners[i][axis][k] - high[axis]) - low[axis]);
                [
                    m.x_axis.x * x + m.y_axis.x * y + m.z_axis.x * z,
                    m.x_axis.y * x + m.y_axis.y * y + m.z_axis.y * z,
                    m.x_axis.z * x + m.y_axis.z * y + m.z_axis.z * z,
                ]
            };
            let [a, b, c] = [corner(0), corner(1), corner(2)];
            for axis in 0..3 {
                survey.corners[0][axis][k] = a[axis];
                survey.corners[1][axis][k] = b[axis];
                survey.corners[2][axis][k] = c[axis];
            }
            // Off the light on one side: X, -X, Y or -Y is larger than Z at every corner.
            let least = |sign: f32, axis: usize| {
                let over = |p: [f32; 3]| sign * p[axis] - wide * p[2];
                min3(over(a), over(b), over(c))
            };
            let outside = max(max(least(1.0, 0), least(-1.0, 0)), max(least(1.0, 1), least(-1.0, 1)));
            let nearest = min3(a[2], b[2], c[2]);
            let farthest = -min3(-a[2], -b[2], -c[2]);
            let (n0, n1, n2) = (edge(b, c), edge(c, a), edge(a, b));
            let volume = a[0] * n0[0] + a[1] * n0[1] + a[2] * n0[2];
            let sign = if volume < 0.0 { -1.0 } else { 1.0 };
            survey.volume[k] = volume * sign;
            // An edge's least and largest value on the light.
            let (mut smallest, mut largest) = (f32::INFINITY, f32::INFINITY);
            for (into, n) in survey.edges.iter_mut().zip([n0, n1, n2]) {
                let [a, b, c] = n.map(|v| v * sign);
                into[0][k] = a;
                into[1][k] = b;
                into[2][k] = c;
                let reach = if frame.round { (a * a + b * b).sqrt() } else { a.abs() + b.abs() };
                smallest = min(smallest, c - reach);
                largest = min(largest, c + reach);
            }
            let some = (outside <= 0.0) & (farthest > 0.0) & (nearest < far) & (largest >= 0.0) & (volume != 0.0);
            let beyond = farthest >= near;
            flags[k] = if some { SOME } else { 0 }
                | if smallest >= 0.0 { WHOLE } else { 0 }
                | if beyond { STRADDLE } else { 0 };
        }
        survey.some = bits(&flags, SOME) & self.used;
        survey.straddle = bits(&flags, STRADDLE);
        survey.whole = bits(&flags, WHOLE) & survey.some & !survey.straddle;
        survey
    }

    pub(crate) fn triangle(&self, lane: usize) -> [Vec3; 3] {
        [0, 1, 2].map(|corner| Vec3::from_array([0, 1, 2].map(|axis| self.corners[corner][axis][lane])))
    }
}

impl Survey {
    pub(crate) fn edges(&self, lane: usize) -> [Edge; 3] {
        self.edges.map(|[a, b, c]| Edge { a: a[lane], b: b[lane], c: c[lane] })
    }

    /// The plane's own form, for a triangle that crosses a flat light at a depth: nearer than that.
    pub(crate) fn nearer(&self, lane: usize, depth: f32) -> Edge {
        let [a, b, c] = [0, 1, 2].map(|i| self.edges.iter().map(|edge| edge[i][lane]).sum::<f32>());
        Edge { a, b, c: c - self.volume[lane] / depth }
    }

    /// The least and the largest of `p X + q Y` over the triangle's picture; `None` when it reaches
    /// behind the receiver.
    #[inline(always)]
    pub(crate) fn extent(&self, lane: usize, [p, q]: [f32; 2]) -> Option<[f32; 2]> {
        let [a, b, c] = self.corners.map(|[x, y, z]| [p * x[lane] + q * y[lane], z[lane]]);
        let nearest = min3(a[1], b[1], c[1]);
        let farthest = -min3(-a[1], -b[1], -c[1]);
        if nearest <= 1e-6 * farthest {
            return None;
        }
        let [a, b, c] = [a, b, c].map(|[y, z]| y / z);
        Some([min3(a, b, c), -min3(-a, -b, -c)])
    }
}

/// The cross product of sum and difference, halved: `from x to`, but it negates exactly when the
/// ends change places. Nothing leaks between neighbours.
#[inline(always)]
fn edge(from: [f32; 3], to: [f32; 3]) -> [f32; 3] {
    let s = [0, 1, 2].map(|i| 0.5 * (from[i] + to[i]));
    let d = [0, 1, 2].map(|i| to[i] - from[i]);
    [s[1] * d[2] - s[2] * d[1], s[2] * d[0] - s[0] * d[2], s[0] * d[1] - s[1] * d[0]]
}

#[inline(always)]
fn min(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

#[inline(always)]
fn max(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

#[inline(always)]
fn min3(a: f32, b: f32, c: f32) -> f32 {
    min(min(a, b), c)
}

#[inline(always)]
fn bits(flags: &[u32; LANES], flag: u32) -> u32 {
    let mut bits = [0u32; LANES];
    for (k, bits) in bits.iter_mut().enumerate() {
        *bits = if flags[k] & flag != 0 { 1 << k } else { 0 };
    }
    bits.iter().sum()
}
