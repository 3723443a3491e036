//! Rays to eight samples of the light at once, for what is too dense to be taken for edges.
//!
//! A ray of a packet asks what `rays::blocked` asks, and triangles answer in f64, operation by operation as
//! `surfaces::intersect` does.

use super::eight::{Eight, LANES};
use crate::aim::Aim;
use crate::rays;
use crate::receiver::Receiver;
use crate::samples::LightSamples;
use crate::surfaces::{BOX_END, Surfaces};
use crate::wide::{Wide, Wide3};
use glam::Vec3A;
use obvhs::bvh2::node::Bvh2Node;

/// From one receiver.
pub(super) struct Packet<'a> {
    surfaces: &'a Surfaces,
    receiver: &'a Receiver,
    /// The only triangles that count, if not all do.
    only: Option<&'a [u32]>,
    direction: Wide3,
    end: Wide,
    /// As obvhs sees a ray.
    origin: [f32; 3],
    inverse: [Eight; 3],
    box_end: Eight,
}

impl<'a> Packet<'a> {
    pub(super) fn new(surfaces: &'a Surfaces, receiver: &'a Receiver, only: Option<&'a [u32]>) -> Self {
        Self {
            surfaces,
            receiver,
            only,
            direction: Wide3::ZERO,
            end: Wide::all(0.0),
            origin: receiver.position.as_vec3a().to_array(),
            inverse: [Eight::all(1.0); 3],
            box_end: Eight::all(0.0),
        }
    }

    /// Aims a ray at the only one of some samples.
    #[inline(always)]
    pub(super) fn aim(&mut self, lane: usize, aim: &Aim, one: &LightSamples) {
        let line = rays::line(self.receiver, aim, one, 0);
        self.direction.set(lane, line.direction);
        self.end.0[lane] = line.range[1];
        self.box_end.0[lane] = (line.range[1] * BOX_END) as f32;
        for axis in 0..3 {
            // As `Line::boxes` and `obvhs::ray::safe_inverse`.
            let along = line.direction[axis] as f32 + 0.0;
            let small = along.abs() <= f32::EPSILON;
            self.inverse[axis].0[lane] =
                if small { 1f32.copysign(along) / f32::EPSILON } else { 1.0 / along };
        }
    }

    /// A bit for each of some rays that a surface blocks.
    #[inline(always)]
    pub(super) fn blocked(&self, some: u32, open: &mut Vec<u32>) -> u32 {
        let nodes = &self.surfaces.bvh.nodes[..];
        let mut left = some;
        if let Some(slots) = self.only {
            for &slot in slots {
                left &= !self.crosses(slot, left);
            }
            return some & !left;
        }
        open.clear();
        open.push(0);
        while let Some(index) = open.pop() {
            let node = &nodes[index as usize];
            if self.meets(node) & left == 0 {
                continue;
            }
            let first = node.first_index;
            if !node.is_leaf() {
                open.extend([first, first + 1]);
                continue;
            }
            for slot in first..first + node.prim_count {
                left &= !self.crosses(slot, left);
            }
            if left == 0 {
                break;
            }
        }
        some & !left
    }

    /// Which rays meet a box.
    #[inline(always)]
    fn meets(&self, node: &Bvh2Node) -> u32 {
        let (low, high): (Vec3A, Vec3A) = (node.aabb().min, node.aabb().max);
        let mut first = Eight::all(0.0);
        let mut last = self.box_end;
        for axis in 0..3 {
            let one = Eight::all(low[axis] - self.origin[axis]) * self.inverse[axis];
            let other = Eight::all(high[axis] - self.origin[axis]) * self.inverse[axis];
            first = first.max(one.min(other));
            last = last.min(one.max(other));
        }
        last.below(first).not().bits()
    }

    /// Which of some rays cross a triangle that may shadow the receiver.
    #[inline(always)]
    fn crosses(&self, slot: u32, some: u32) -> u32 {
        let [a, b, c] = self.surfaces.corners_f64(slot);
        let (ab, ac, s) = (b - a, c - a, self.receiver.position - a);
        let q = s.cross(ab);
        let (ab, q_along) = (Wide3::all(ab), Wide::all(ac.dot(q)));
        let p = self.direction.cross(Wide3::all(ac));
        let determinant = ab.dot(p);
        let u = Wide3::all(s).dot(p) / determinant;
        let v = self.direction.dot(Wide3::all(q)) / determinant;
        let distance = q_along / determinant;
        let mut hit = 0;
        for k in 0..LANES {
            let inside = u.0[k] >= 0.0 && v.0[k] >= 0.0 && u.0[k] + v.0[k] <= 1.0;
            let between = distance.0[k] > 0.0 && distance.0[k] < self.end.0[k];
            hit |= u32::from(determinant.0[k] != 0.0 && inside && between) << k;
        }
        hit &= some;
        if hit == 0 || self.receiver.skips(slot, &self.surfaces.corners[slot as usize]) {
            return 0;
        }
        if self.surfaces.is_cut(slot) {
            for k in 0..LANES {
                let there = hit >> k & 1 != 0 && self.surfaces.is_there(slot, [u.0[k], v.0[k]]);
                hit &= !(u32::from(!there) << k);
            }
        }
        hit
    }
}
