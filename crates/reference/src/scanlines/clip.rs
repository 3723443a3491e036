//! Triangles that reach behind the receivers of a group are cut at a plane before them.
//!
//! What is cut off hides nothing if the triangle's own plane leaves all of the receivers' views up to the cut on one
//! side: `facing` asks for that.

use super::facing::ROUNDING;
use crate::aim::{Aim, Spread};
use glam::{DVec3, Vec3};

/// How far before the receivers, in halves of the longest side of their box.
const BEFORE: f64 = 0.2;

/// And in metres at least, for receivers at one place: hundreds of ulps of a coordinate of some metres.
const LEAST: f64 = 1e-5;

/// Ways to the light longer than this over their depth are too flat to be followed up to a plane.
const STEEPEST: f64 = 8.0;

/// A plane parallel to a flat light, or across the way to a sun.
pub(super) struct Clip {
    axis: DVec3,
    /// From the group's centre along the axis.
    height: f64,
    centre: DVec3,
    /// From a receiver to where its view meets the plane, and half of the box around such ways.
    drift: [Vec3; 2],
}

/// The unit vector towards a light at which its depths are measured: across a flat one, to the middle of a cone.
/// Zero for a flat light without an area.
pub(super) fn upright(aim: &Aim) -> DVec3 {
    match aim.spread {
        Spread::Area => {
            let axis = aim.u.cross(aim.v).normalize_or_zero();
            if axis.dot(aim.axis) < 0.0 { -axis } else { axis }
        }
        Spread::Cone { .. } => aim.axis.normalize(),
    }
}

impl Clip {
    /// Before receivers between two heights, in a box; `aim` is the centre's. `None` where the light is too flat.
    pub(super) fn new(centre: Vec3, half: Vec3, aim: &Aim, [lowest, highest]: [f64; 2]) -> Option<Self> {
        let axis = upright(aim);
        let height = highest + f64::from(half.max_element()) * BEFORE + LEAST;
        // Ways to the light that end at this depth: their middle, and how far others end from it.
        let depth = height - lowest;
        let (rise, half) = (axis.dot(aim.axis), half.as_dvec3());
        let (steep, flattest) = (depth / rise, depth / (rise - axis.abs().dot(half)));
        if !(flattest > 0.0 && flattest * aim.axis.length() < STEEPEST * depth) {
            return None;
        }
        let spread = (aim.u.abs() + aim.v.abs() + half) * flattest + aim.axis.abs() * (flattest - steep);
        let middle = (aim.axis * steep).as_vec3();
        let widest = spread.as_vec3() * (1.0 + ROUNDING) + middle.abs() * ROUNDING;
        Some(Self { axis, height, centre: centre.as_dvec3(), drift: [middle, widest] })
    }

    pub(super) fn height(&self) -> f32 {
        self.height as f32
    }

    pub(super) fn drift(&self) -> [Vec3; 2] {
        self.drift
    }

    /// The part of a side that is before the plane.
    pub(super) fn before(&self, [from, to]: [Vec3; 2]) -> Option<[Vec3; 2]> {
        match (self.over(from) > 0.0, self.over(to) > 0.0) {
            (true, true) => Some([from, to]),
            (true, false) => Some([from, self.between(from, to)]),
            (false, true) => Some([self.between(from, to), to]),
            (false, false) => None,
        }
    }

    /// The edge that a triangle gets where it is cut, the way that its other sides go round.
    pub(super) fn across(&self, corners: &[Vec3; 3]) -> Option<[Vec3; 2]> {
        let (mut from, mut to) = (None, None);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            match (self.over(a) > 0.0, self.over(b) > 0.0) {
                (true, false) => from = Some(self.between(a, b)),
                (false, true) => to = Some(self.between(a, b)),
                _ => {}
            }
        }
        Some([from?, to?])
    }

    fn over(&self, place: Vec3) -> f64 {
        self.axis.dot(place.as_dvec3() - self.centre) - self.height
    }

    /// Where a side crosses the plane: the same place from both ends.
    fn between(&self, a: Vec3, b: Vec3) -> Vec3 {
        let (a, b) = if a.to_array() < b.to_array() { (a, b) } else { (b, a) };
        let (p, q) = (self.over(a), self.over(b));
        a.as_dvec3().lerp(b.as_dvec3(), p / (p - q)).as_vec3()
    }
}
