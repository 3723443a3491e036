//! The pyramid from a receiver round the light, against boxes: conservative, in f32.

use crate::aim::{Aim, Outline};
use crate::receiver::Receiver;
use glam::{BVec3A, DVec3, Vec3, Vec3A, Vec4};
use obvhs::aabb::Aabb;

/// A light narrower than this (of its distance) is given this width: a light of no size would have
/// side planes of no direction. Widening only gathers more.
const NARROWEST: f64 = 1e-6;

/// Rounding of the f32 arithmetic below, in ulps of the scene's extent: a handful of operations of
/// half an ulp (2^-24) each.
const ROUNDING: f32 = 16.0 / (1 << 24) as f32;

pub(crate) struct Shaft {
    apex: Vec3A,
    slack: Vec3A,
    sides: Sides,
    slabs: Slabs,
    /// The receiver's horizon; zero without one.
    up: Vec3A,
}

impl Shaft {
    pub(crate) fn new(receiver: &Receiver, aim: &Aim, extent: f32) -> Self {
        let (u, v) = widened(aim);
        let apex = receiver.position.as_vec3a();
        Self {
            apex,
            slack: Vec3A::splat(ROUNDING * (extent + apex.abs().max_element())),
            sides: Sides::new(aim.axis, u, v),
            slabs: Slabs::new(aim, u, v),
            up: receiver.normal.as_vec3a(),
        }
    }

    /// Whether a box may hold something between the receiver and the light.
    pub(crate) fn touches(&self, bounds: &Aabb) -> bool {
        let (low, high) = (bounds.min - self.apex, bounds.max - self.apex);
        let highest = Vec3A::select(self.up.cmpgt(Vec3A::ZERO), high, low);
        let rises = self.up.dot(highest) > 0.0 || self.up == Vec3A::ZERO;
        rises
            && self.slabs.meet(low - self.slack, high + self.slack)
            && self.sides.meet((low + high) * 0.5, (high - low) * 0.5 + self.slack)
    }

    /// Whether the pyramid misses a triangle.
    pub(crate) fn misses(&self, corners: &[Vec3; 3]) -> bool {
        let [a, b, c] = corners.map(|v| Vec3A::from(v) - self.apex);
        let (low, high) = (a.min(b).min(c) - self.slack, a.max(b).max(c) + self.slack);
        !self.slabs.meet(low, high) || self.sides.part([a, b, c], self.slack.x)
    }
}

/// The four side planes: they cut off what the light's own axes separate.
struct Sides {
    /// Unit normals, pointing inwards: the x of all four, then y, then z; and their absolute values.
    inwards: [Vec4; 3],
    inwards_abs: [Vec4; 3],
}

impl Sides {
    fn new(axis: DVec3, u: DVec3, v: DVec3) -> Self {
        let sides = [
            side(axis + u, v, axis),
            side(axis - u, v, axis),
            side(axis + v, u, axis),
            side(axis - v, u, axis),
        ];
        let column = |i: usize| Vec4::from_array(sides.map(|side| side[i]));
        let inwards = [0, 1, 2].map(column);
        Self { inwards, inwards_abs: inwards.map(Vec4::abs) }
    }

    fn meet(&self, centre: Vec3A, half: Vec3A) -> bool {
        let reach =
            self.inwards_abs[0] * half.x + self.inwards_abs[1] * half.y + self.inwards_abs[2] * half.z;
        (self.distances(centre) + reach).cmpge(Vec4::ZERO).all()
    }

    /// Whether all corners are outside one plane, by more than the slack.
    fn part(&self, corners: [Vec3A; 3], slack: f32) -> bool {
        let [a, b, c] = corners.map(|corner| self.distances(corner).cmplt(Vec4::splat(-slack)));
        (a & b & c).any()
    }

    fn distances(&self, place: Vec3A) -> Vec4 {
        self.inwards[0] * place.x + self.inwards[1] * place.y + self.inwards[2] * place.z
    }
}

/// The plane through the apex that holds an edge of the light, its normal towards the axis. Zero,
/// which keeps everything, when the light is seen edge-on.
fn side(middle_of_edge: DVec3, along_edge: DVec3, axis: DVec3) -> Vec3 {
    let normal = middle_of_edge.cross(along_edge).normalize_or_zero();
    let height = normal.dot(axis);
    if height.abs() <= 1e-9 * axis.length() {
        return Vec3::ZERO;
    }
    (normal * height.signum()).as_vec3()
}

/// The slab test of a ray whose direction is an interval. With directions between `low` and `high`
/// the pyramid holds, at parameter k, the coordinates from `k low` to `k high`: each face of a box
/// bounds k from below or above. This cuts off what the world's axes separate, long boxes above all.
struct Slabs {
    low_inverse: Vec3A,
    high_inverse: Vec3A,
    low_is_positive: BVec3A,
    high_is_positive: BVec3A,
    /// k at the far end of the light.
    far: f32,
}

impl Slabs {
    fn new(aim: &Aim, u: DVec3, v: DVec3) -> Self {
        // Never zero, rounded outwards.
        let reach = match aim.outline {
            Outline::Square => u.abs() + v.abs(),
            Outline::Disk => (u * u + v * v).map(f64::sqrt),
        } + DVec3::splat(1e-6 * aim.axis.length());
        let nonzero = |x: Vec3A| Vec3A::select(x.abs().cmplt(Vec3A::splat(1e-30)), Vec3A::splat(1e-30), x);
        let (low, high) = (nonzero((aim.axis - reach).as_vec3a()), nonzero((aim.axis + reach).as_vec3a()));
        Self {
            low_inverse: low.recip(),
            high_inverse: high.recip(),
            low_is_positive: low.cmpgt(Vec3A::ZERO),
            high_is_positive: high.cmpgt(Vec3A::ZERO),
            far: (1.0 / aim.nearness()[0]) as f32 * (1.0 + ROUNDING),
        }
    }

    /// Whether some k has `k high >= box low` and `k low <= box high` on all axes.
    fn meet(&self, box_low: Vec3A, box_high: Vec3A) -> bool {
        let (first, last) = (box_low * self.high_inverse, box_high * self.low_inverse);
        let least = Vec3A::select(self.high_is_positive, first, Vec3A::ZERO);
        let least = least.max(Vec3A::select(self.low_is_positive, Vec3A::ZERO, last));
        let most = Vec3A::select(self.high_is_positive, Vec3A::INFINITY, first);
        let most = most.min(Vec3A::select(self.low_is_positive, last, Vec3A::INFINITY));
        least.max_element().max(0.0) <= most.min_element().min(self.far)
    }
}

/// The light's half axes, none of them shorter than [`NARROWEST`].
fn widened(aim: &Aim) -> (DVec3, DVec3) {
    let least = NARROWEST * aim.axis.length();
    let (p, q) = aim.axis.normalize_or(DVec3::Y).any_orthonormal_pair();
    match (aim.u.length() > least, aim.v.length() > least) {
        (true, true) => (aim.u, aim.v),
        (false, false) => (p * least, q * least),
        (true, false) => (aim.u, aim.axis.cross(aim.u).normalize_or(q) * least),
        (false, true) => (aim.axis.cross(aim.v).normalize_or(p) * least, aim.v),
    }
}
