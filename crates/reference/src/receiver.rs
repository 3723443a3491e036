//! A surface point that looks at the light.
//!
//! Its place is never lifted off the surface: an offset of 1e-4 m already darkens or brightens
//! contact shadows. It is put exactly onto its triangle's plane in f64, and the surfaces that must
//! not shadow it are named instead.

use crate::{Points, surfaces::Surfaces};
use glam::{DVec3, Vec3};

/// Coordinates are f32. A vertex that was meant to lie in the receiver's plane misses it by half an
/// ulp (2^-24 of its coordinates) for itself and for each of the three vertices that span the
/// plane: 2^-22 in all. A real blocker 1e-5 m away stays above that up to 40 m from the origin (at
/// any distance when the plane is parallel to an axis).
pub(crate) const COPLANAR: f64 = 1.0 / (1 << 22) as f64;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Receiver {
    /// World position in metres, on its triangle's plane to f64's rounding.
    pub(crate) position: DVec3,
    /// Unit normal on the viewer's side; zero for a point in mid-air, which has no horizon.
    pub(crate) normal: DVec3,
    /// Its own triangle.
    pub(crate) slot: Option<u32>,
}

impl Receiver {
    /// One of the points. A point without a triangle keeps its place and normal as given.
    pub(crate) fn new(surfaces: &Surfaces, points: &Points, index: usize) -> Self {
        Self::beside(None, surfaces, points, index)
    }

    /// The same after another, whose normal it has if they are on one side of one triangle.
    #[inline(always)]
    pub(crate) fn beside(other: Option<&Self>, surfaces: &Surfaces, points: &Points, index: usize) -> Self {
        let position = points.position[index].as_dvec3();
        let Some(slot) = surfaces.slot(points.triangle[index]) else {
            let normal = points.normal[index].as_dvec3().normalize_or_zero();
            return Self { position, normal, slot: None };
        };
        let given = points.normal[index].as_dvec3();
        let own = match other {
            Some(other) if other.slot == Some(slot) && other.normal.dot(given) > 0.5 => other.normal,
            _ => {
                let normal = given.normalize_or_zero();
                let [a, b, c] = surfaces.corners_f64(slot);
                let Some(own) = (b - a).cross(c - a).try_normalize() else {
                    return Self { position, normal, slot: Some(slot) };
                };
                if own.dot(normal) < 0.0 { -own } else { own }
            }
        };
        let a = surfaces.corners[slot as usize][0].as_dvec3();
        Self { position: position + own * own.dot(a - position), normal: own, slot: Some(slot) }
    }

    /// A place that a ray has hit, seen from `normal`'s side.
    pub(crate) fn hit(slot: u32, position: DVec3, normal: DVec3) -> Self {
        Self { position, normal, slot: Some(slot) }
    }

    /// A place without a surface.
    pub(crate) fn in_air(position: DVec3) -> Self {
        Self { position, normal: DVec3::ZERO, slot: None }
    }

    /// Whether it has neither a surface of its own nor a horizon.
    pub(crate) fn is_in_air(&self) -> bool {
        self.slot.is_none() && self.normal == DVec3::ZERO
    }

    /// Whether a triangle cannot shadow this point: its own, one in the same plane, or one that
    /// lies wholly below the horizon.
    pub(crate) fn skips(&self, slot: u32, corners: &[Vec3; 3]) -> bool {
        self.slot == Some(slot) || (self.normal != DVec3::ZERO && !corners.iter().any(|&v| self.rises(v)))
    }

    fn rises(&self, vertex: Vec3) -> bool {
        let vertex = vertex.as_dvec3();
        let rounding = COPLANAR * self.normal.abs().dot(vertex.abs().max(self.position.abs()));
        self.normal.dot(vertex - self.position) > rounding
    }
}
