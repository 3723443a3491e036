//! The pyramid from a receiver round the light, against boxes: conservative, in f32.

use crate::aim::Aim;
use crate::receiver::Receiver;
use glam::{DVec3, Vec3, Vec3A, Vec4};
use obvhs::aabb::Aabb;

/// A light narrower than this (of its distance) is given this width: a light of no size would have
/// side planes of no direction. Widening only gathers more.
const NARROWEST: f64 = 1e-6;

/// Rounding of the f32 arithmetic below, in ulps of the scene's extent: a handful of operations of
/// half an ulp (2^-24) each.
const ROUNDING: f32 = 16.0 / (1 << 24) as f32;

pub(crate) struct Shaft {
    apex: Vec3A,
    /// Unit normals of the four side planes, pointing inwards, as columns x, y, z; then their
    /// absolute values.
    sides: [Vec4; 3],
    sides_abs: [Vec4; 3],
    /// The receiver's horizon; zero without one.
    up: Vec3A,
    /// Bounds of the receiver and the light.
    low: Vec3A,
    high: Vec3A,
    slack: f32,
}

impl Shaft {
    pub(crate) fn new(receiver: &Receiver, aim: &Aim, extent: f32) -> Self {
        let (u, v) = widened(aim);
        let sides = [
            side(aim.axis + u, v, aim.axis),
            side(aim.axis - u, v, aim.axis),
            side(aim.axis + v, u, aim.axis),
            side(aim.axis - v, u, aim.axis),
        ];
        let column = |pick: fn(&Vec3) -> f32| Vec4::from_array([0, 1, 2, 3].map(|i| pick(&sides[i])));
        let sides = [column(|s| s.x), column(|s| s.y), column(|s| s.z)];
        let apex = receiver.position.as_vec3a();
        let (low, high) = bounds(receiver, aim, [u, v], extent);
        Self {
            apex,
            sides,
            sides_abs: sides.map(Vec4::abs),
            up: receiver.normal.as_vec3a(),
            low,
            high,
            slack: ROUNDING * (extent + apex.abs().max_element()),
        }
    }

    /// Whether a box may hold something between the receiver and the light.
    pub(crate) fn touches(&self, bounds: &Aabb) -> bool {
        if (bounds.min.cmpgt(self.high) | bounds.max.cmplt(self.low)).any() {
            return false;
        }
        let centre = (bounds.min + bounds.max) * 0.5 - self.apex;
        let half = (bounds.max - bounds.min) * 0.5;
        let inwards = self.inwards(centre)
            + self.sides_abs[0] * half.x
            + self.sides_abs[1] * half.y
            + self.sides_abs[2] * half.z;
        let highest = Vec3A::select(self.up.cmpgt(Vec3A::ZERO), bounds.max, bounds.min);
        let rises = self.up.dot(highest - self.apex);
        inwards.cmpge(Vec4::splat(-self.slack)).all() && (rises > 0.0 || self.up == Vec3A::ZERO)
    }

    /// Whether a triangle is wholly outside one side of the pyramid.
    pub(crate) fn misses(&self, corners: &[Vec3; 3]) -> bool {
        let outside = Vec4::splat(-self.slack);
        let [a, b, c] = corners.map(|v| self.inwards(Vec3A::from(v) - self.apex).cmplt(outside));
        (a & b & c).any()
    }

    /// Distance of a place, relative to the apex, from each side plane.
    fn inwards(&self, place: Vec3A) -> Vec4 {
        self.sides[0] * place.x + self.sides[1] * place.y + self.sides[2] * place.z
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

/// A box round the receiver and the light; a sun's reaches past the scene.
fn bounds(receiver: &Receiver, aim: &Aim, [u, v]: [DVec3; 2], extent: f32) -> (Vec3A, Vec3A) {
    let far = match aim.nearness()[0] {
        0.0 => 8.0 * (f64::from(extent) + receiver.position.abs().max_element()) + 1.0,
        nearest => 1.0 / nearest,
    };
    let corners = [u + v, u - v, v - u, -u - v].map(|c| receiver.position + (aim.axis + c) * far);
    let low = corners.iter().fold(receiver.position, |low, &c| low.min(c));
    let high = corners.iter().fold(receiver.position, |high, &c| high.max(c));
    let slack = Vec3A::splat(ROUNDING * (extent + receiver.position.as_vec3().abs().max_element()));
    (low.as_vec3a() - slack, high.as_vec3a() + slack)
}
