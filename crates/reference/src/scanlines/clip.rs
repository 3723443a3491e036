//! Triangles that reach behind the receivers of a group are cut at a plane before them, those that reach through a
//! flat light at the light.
//!
//! A place where a side is cut is rounded to f32, as vertices are, and may bend the side by half an ulp of its coordinates:
//! of a few samples within a centimetre of a receiver in a hall, of more where coordinates are hundreds of metres.
//!
//! What is cut off hides nothing. Behind the receivers it does not if the triangle's own plane leaves all of the receivers' views up to the cut on one
//! side: `facing` asks for that.

use super::facing::ROUNDING;
use crate::aim::{Aim, Spread};
use glam::{DVec3, Vec3};

/// How far before the receivers, in halves of the longest side of their box.
const BEFORE: f64 = 0.2;

/// And at least, for receivers at one place: in metres, and in ulps of the largest coordinate.
const LEAST: [f64; 2] = [1e-5, 256.0 * f32::EPSILON as f64];

/// Ways to the light longer than this over their depth are too flat to be followed up to a plane.
const STEEPEST: f64 = 8.0;

/// Two planes parallel to a flat light, or one across the way to a sun, between which triangles count.
pub(super) struct Clip {
    axis: DVec3,
    centre: DVec3,
    near: Option<Near>,
    /// From the group's centre along the axis.
    far: f64,
}

/// The plane before the receivers.
struct Near {
    /// From the group's centre along the axis.
    height: f64,
    /// From a receiver to where its view meets the plane, and half of the box around such ways.
    drift: [Vec3; 2],
}

/// At which planes a triangle has to be cut.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Cut {
    pub(super) near: bool,
    pub(super) far: bool,
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

impl Near {
    /// Before receivers between two heights, in a box; `aim` is the centre's. `None` where the light is too flat.
    fn new([centre, half]: [Vec3; 2], axis: DVec3, aim: &Aim, [lowest, highest]: [f64; 2]) -> Option<Self> {
        let least = LEAST[0].max(LEAST[1] * f64::from(centre.abs().max_element()));
        let height = highest + f64::from(half.max_element()) * BEFORE + least;
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
        Some(Self { height, drift: [middle, widest] })
    }
}

impl Clip {
    /// For receivers between two heights, in a box; `aim` is the centre's; `far` the height at which a flat light
    /// begins.
    pub(super) fn new(centre: Vec3, half: Vec3, aim: &Aim, heights: [f64; 2], far: f64) -> Self {
        let axis = upright(aim);
        Self { axis, centre: centre.as_dvec3(), near: Near::new([centre, half], axis, aim, heights), far }
    }

    /// Of the plane before the receivers, if there is one.
    pub(super) fn height(&self) -> Option<f32> {
        self.near.as_ref().map(|near| near.height as f32)
    }

    pub(super) fn drift(&self) -> [Vec3; 2] {
        self.near.as_ref().map_or([Vec3::ZERO; 2], |near| near.drift)
    }

    /// The part of a side that is between the planes. Each end that is not moves to its own plane, along the whole side,
    /// so that all triangles that have it there have the same place.
    pub(super) fn between(&self, [from, to]: [Vec3; 2], cut: Cut) -> Option<[Vec3; 2]> {
        let mut ends = [from, to];
        for plane in self.planes(cut).into_iter().flatten() {
            match (self.inside(from, plane), self.inside(to, plane)) {
                (true, true) => {}
                (true, false) => ends[1] = self.at(from, to, plane),
                (false, true) => ends[0] = self.at(from, to, plane),
                (false, false) => return None,
            }
        }
        Some(ends)
    }

    /// The edges that a triangle gets where it is cut, the way that its other sides go round.
    pub(super) fn across(&self, corners: &[Vec3; 3], cut: Cut) -> [Option<[Vec3; 2]>; 2] {
        self.planes(cut).map(|plane| {
            let (mut from, mut to) = (None, None);
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                match (self.inside(a, plane?), self.inside(b, plane?)) {
                    (true, false) => from = Some(self.at(a, b, plane?)),
                    (false, true) => to = Some(self.at(a, b, plane?)),
                    _ => {}
                }
            }
            Some([from?, to?])
        })
    }

    /// Heights at which is cut, and on which side triangles count: 1 above, -1 below.
    fn planes(&self, cut: Cut) -> [Option<[f64; 2]>; 2] {
        let near = self.near.as_ref().filter(|_| cut.near);
        [near.map(|near| [near.height, 1.0]), cut.far.then_some([self.far, -1.0])]
    }

    fn inside(&self, place: Vec3, [height, side]: [f64; 2]) -> bool {
        self.over(place, height) * side > 0.0
    }

    fn over(&self, place: Vec3, height: f64) -> f64 {
        self.axis.dot(place.as_dvec3() - self.centre) - height
    }

    /// Where a side crosses a plane: the same place from both ends.
    fn at(&self, a: Vec3, b: Vec3, [height, _]: [f64; 2]) -> Vec3 {
        let (a, b) = if a.to_array() < b.to_array() { (a, b) } else { (b, a) };
        let (p, q) = (self.over(a, height), self.over(b, height));
        a.as_dvec3().lerp(b.as_dvec3(), p / (p - q)).as_vec3()
    }
}
