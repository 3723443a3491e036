//! Edges in eights, and what a receiver sees of them.

use super::blocks::edge;
use super::candidates::Edge;
use super::eight::{Eight, LANES, bytes};
use super::frame::Frame;
use super::outline::MARGIN;
use glam::Vec3;

/// Eight edges, or fewer.
#[derive(Clone, Copy, Default)]
pub(super) struct Edges {
    from: [Eight; 3],
    to: [Eight; 3],
    /// Per edge: up to two owners, and what each adds to the number of layers on the right of the edge where it
    /// runs upwards.
    pub(super) owners: [[u32; LANES]; 2],
    pub(super) sides: [[i8; LANES]; 2],
    /// Sum of both sides.
    pub(super) weight: [i8; LANES],
    /// A bit for each edge, and for those that an open triangle owns.
    used: u32,
    pub(super) open: u32,
}

/// Edges in eights.
#[derive(Default)]
pub(super) struct EdgeList {
    pub(super) blocks: Vec<Edges>,
    filled: usize,
}

/// Eight edges from one receiver, in the light's coordinates.
#[derive(Clone, Copy)]
pub(super) struct Seen {
    /// `a x + b y + c`, 0 on the edge.
    pub(super) line: [Eight; 3],
    pub(super) from: [Eight; 2],
    pub(super) to: [Eight; 2],
    pub(super) weight: [i8; LANES],
    /// A bit for each that may cross the light.
    pub(super) touching: u32,
    /// Those that pass the light's middle on its left, and those of them that run upwards.
    pub(super) passing: u32,
    pub(super) rising: u32,
}

impl EdgeList {
    pub(super) fn clear(&mut self) {
        self.blocks.clear();
        self.filled = 0;
    }

    pub(super) fn push(&mut self, edge: &Edge) {
        let lane = self.filled % LANES;
        if lane == 0 {
            self.blocks.push(Edges::default());
        }
        if let Some(last) = self.blocks.last_mut() {
            last.set(lane, edge);
        }
        self.filled += 1;
    }
}

impl Edges {
    fn set(&mut self, lane: usize, edge: &Edge) {
        let [from, to] = edge.ends;
        for axis in 0..3 {
            self.from[axis].0[lane] = from[axis];
            self.to[axis].0[lane] = to[axis];
        }
        for i in 0..2 {
            self.owners[i][lane] = edge.owners[i];
            self.sides[i][lane] = edge.sides[i];
        }
        self.weight[lane] = edge.sides[0] + edge.sides[1];
        self.used |= 1 << lane;
        self.open |= u32::from(edge.open) << lane;
    }

    pub(super) fn ends(&self, lane: usize) -> [Vec3; 2] {
        [&self.from, &self.to].map(|end| Vec3::new(end[0].0[lane], end[1].0[lane], end[2].0[lane]))
    }

    #[inline(always)]
    pub(super) fn see(&self, frame: &Frame) -> Seen {
        let a = place(frame, &self.from);
        let b = place(frame, &self.to);
        let line = edge(&a, &b);
        let from = [a[0] / a[2], a[1] / a[2]];
        let to = [b[0] / b[2], b[1] / b[2]];
        let (zero, end) = (Eight::all(0.0), Eight::all(1.0 + MARGIN));
        let [p, q, r] = line;
        let reach = if frame.round { (p * p + q * q).sqrt() } else { p.abs() + q.abs() };
        let apart = (reach * end).below(r.abs());
        let low = from[0].min(to[0]).max(from[1].min(to[1]));
        let high = from[0].max(to[0]).min(from[1].max(to[1]));
        let apart = apart.or(end.below(low)).or(high.below(-end));
        let rising = from[1].below(to[1]);
        // The middle's row is above one end and not above the other.
        let passing = zero.below(from[1]).same(zero.below(to[1])).not();
        // Where it crosses that row, a x + c = 0: on the left where both have one sign.
        let left = (-(p * r)).below(zero);
        // What f32 tells of that may be noise for an edge along the row: its ends are not.
        let (west, east) = (from[0].min(to[0]), from[0].max(to[0]));
        let left = left.and(end.below(west).not()).or(east.below(-end));
        let [apart, rising, passing, _] = bytes([apart, rising, passing.and(left), left]);
        Seen {
            line,
            from,
            to,
            weight: self.weight,
            touching: self.used & !apart,
            passing: self.used & passing,
            rising,
        }
    }
}

#[inline(always)]
fn place(frame: &Frame, corner: &[Eight; 3]) -> [Eight; 3] {
    let [high, low] = frame.place;
    let m = &frame.light_from_world;
    let x = (corner[0] - Eight::all(high.x)) - Eight::all(low.x);
    let y = (corner[1] - Eight::all(high.y)) - Eight::all(low.y);
    let z = (corner[2] - Eight::all(high.z)) - Eight::all(low.z);
    let (p, q, r) = (m.x_axis, m.y_axis, m.z_axis);
    [
        Eight::all(p.x) * x + Eight::all(q.x) * y + Eight::all(r.x) * z,
        Eight::all(p.y) * x + Eight::all(q.y) * y + Eight::all(r.y) * z,
        Eight::all(p.z) * x + Eight::all(q.z) * y + Eight::all(r.z) * z,
    ]
}
