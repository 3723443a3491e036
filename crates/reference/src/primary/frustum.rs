//! What a tile's rays may meet: six half-spaces, tested at once.

use super::camera::CameraRays;
use super::sheet::Sight;
use crate::scanlines::Eight;
use glam::{DVec3, Vec3};
use obvhs::bvh2::node::Bvh2Node;

/// Of f32 arithmetic, here and in obvhs's own test of boxes, in parts of the largest coordinate. Both take fewer
/// than 16 roundings of 2^-24; what obvhs lets pass, this does too.
const ROUNDING: f64 = 64.0 / (1 << 24) as f64;

/// The lane that bounds the depth.
const DEPTH: usize = 5;

/// Planes turned inwards. The lanes: left, right, top, bottom, the eye's plane, and the depth beyond which nothing
/// counts; two are free.
pub(super) struct Frustum {
    /// The normals' positive parts, then their negative ones.
    normal: [[Eight; 3]; 2],
    offset: Eight,
    /// Of the eye along the depth, and what rounding may add to a depth.
    eye: f64,
    slack: f64,
}

/// A box that no ray meets.
pub(super) const MISSED: f32 = f32::NEG_INFINITY;

impl Frustum {
    /// `half`: from the tile's middle to its outermost pixel centres. `extent`: the largest coordinate.
    pub(super) fn new(camera: &CameraRays, sight: &Sight, [across, down]: [f64; 2], extent: f64) -> Self {
        let (right, below, depth) = (sight.right, sight.down, camera.depth);
        let side = |at: DVec3, along: DVec3, inwards: DVec3| {
            let normal = at.cross(along);
            normal.normalize_or_zero() * 1f64.copysign(normal.dot(inwards))
        };
        let normals = [
            side(sight.middle - right * across, below, right),
            side(sight.middle + right * across, below, -right),
            side(sight.middle - below * down, right, below),
            side(sight.middle + below * down, right, -below),
            depth,
            -depth,
        ];
        let rounding = ROUNDING * (extent + sight.eye.abs().max_element());
        let mut frustum = Self {
            normal: [[Eight::all(0.0); 3]; 2],
            offset: Eight::all(f32::NEG_INFINITY),
            eye: depth.dot(sight.eye),
            slack: rounding * depth.abs().element_sum(),
        };
        for (lane, normal) in normals.into_iter().enumerate() {
            for axis in 0..3 {
                let n = normal[axis] as f32;
                frustum.normal[0][axis].0[lane] = n.max(0.0);
                frustum.normal[1][axis].0[lane] = n.min(0.0);
            }
            let slack = rounding * normal.abs().element_sum();
            frustum.offset.0[lane] = (normal.dot(sight.eye) - slack) as f32;
        }
        frustum.offset.0[DEPTH] = f32::NEG_INFINITY;
        frustum
    }

    /// From now on nothing counts beyond a depth.
    #[inline(always)]
    pub(super) fn end(&mut self, depth: f64) {
        self.offset.0[DEPTH] = (-self.eye - depth - self.slack) as f32;
    }

    /// Whether something as near as this is too far away.
    #[inline(always)]
    pub(super) fn is_beyond(&self, near: f32) -> bool {
        near < self.offset.0[DEPTH]
    }

    /// How near a box comes, larger is nearer; [`MISSED`] if no ray meets it.
    #[inline(always)]
    pub(super) fn near(&self, node: &Bvh2Node) -> f32 {
        let (low, high) = (node.aabb().min, node.aabb().max);
        let most = self.normal[0][0] * Eight::all(high.x)
            + self.normal[1][0] * Eight::all(low.x)
            + (self.normal[0][1] * Eight::all(high.y) + self.normal[1][1] * Eight::all(low.y))
            + (self.normal[0][2] * Eight::all(high.z) + self.normal[1][2] * Eight::all(low.z));
        if most.below(self.offset).any() { MISSED } else { most.0[DEPTH] }
    }

    /// Whether a triangle is outside of one of the planes.
    #[inline(always)]
    pub(super) fn misses(&self, corners: &[Vec3; 3]) -> bool {
        let [a, b, c] = [self.heights(corners[0]), self.heights(corners[1]), self.heights(corners[2])];
        a.max(b).max(c).below(self.offset).any()
    }

    #[inline(always)]
    fn heights(&self, v: Vec3) -> Eight {
        (self.normal[0][0] + self.normal[1][0]) * Eight::all(v.x)
            + (self.normal[0][1] + self.normal[1][1]) * Eight::all(v.y)
            + (self.normal[0][2] + self.normal[1][2]) * Eight::all(v.z)
    }
}
