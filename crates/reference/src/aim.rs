//! A light as seen from one receiver: every point of it in two coordinates.
//!
//! Relative to the receiver, the light is the set `(axis + x u + y v) / nearness` with (x, y) in a
//! square or in the unit disk. `nearness` is 1 on flat lights and 0 on a sun; on a sphere it
//! differs from sample to sample and is left to `samples`. What is linear in the direction is then
//! linear in (x, y), whatever the light.

use crate::receiver::Receiver;
use glam::DVec3;
use umbrage_scene::AreaLight;

/// A cone wider than this does not fit into a tangent plane; no light of ours comes near it.
const WIDEST_RADIANS: f64 = 1.55;

/// Which (x, y) belong to the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outline {
    /// |x| <= 1 and |y| <= 1.
    Square,
    /// x^2 + y^2 <= 1.
    Disk,
}

/// How samples are spread, hence how far away they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Spread {
    /// Uniform by area on a flat light: nearness 1.
    Area,
    /// Uniform by solid angle in a cone. `one_minus_cos` is that of its half angle.
    Cone { one_minus_cos: f64, distance: Distance },
}

/// What a cone ends at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Distance {
    /// A sun: nearness 0.
    Infinite,
    /// The near side of a sphere that fills the cone, whose centre is at the axis' end.
    Sphere,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Aim {
    pub(crate) axis: DVec3,
    pub(crate) u: DVec3,
    pub(crate) v: DVec3,
    pub(crate) outline: Outline,
    pub(crate) spread: Spread,
}

/// Where the light stands relative to the surface's horizon on the viewer's side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Elevation {
    Above,
    Across,
    Below,
}

impl Aim {
    /// `None` when the receiver is inside a sphere light.
    pub(crate) fn new(light: &AreaLight, receiver: &Receiver) -> Option<Self> {
        match *light {
            AreaLight::Sun { direction_to_light, angular_diameter_radians } => {
                let axis = direction_to_light.as_dvec3().normalize_or(DVec3::Y);
                let half = 0.5 * f64::from(angular_diameter_radians);
                Some(Self::cone(axis, half.clamp(0.0, WIDEST_RADIANS), Distance::Infinite))
            }
            AreaLight::Disk { centre, normal, radius_world } => {
                let (u, v) = normal.as_dvec3().normalize_or(DVec3::Y).any_orthonormal_pair();
                let radius = f64::from(radius_world);
                let axis = centre.as_dvec3() - receiver.position;
                Some(Self {
                    axis,
                    u: u * radius,
                    v: v * radius,
                    outline: Outline::Disk,
                    spread: Spread::Area,
                })
            }
            AreaLight::Rect { centre, half_u, half_v } => {
                let axis = centre.as_dvec3() - receiver.position;
                let (u, v) = (half_u.as_dvec3(), half_v.as_dvec3());
                Some(Self { axis, u, v, outline: Outline::Square, spread: Spread::Area })
            }
            AreaLight::Sphere { centre, radius_world } => {
                let axis = centre.as_dvec3() - receiver.position;
                let sin = f64::from(radius_world) / axis.length();
                (sin < 1.0).then(|| Self::cone(axis, sin.asin().min(WIDEST_RADIANS), Distance::Sphere))
            }
        }
    }

    fn cone(axis: DVec3, half_angle: f64, distance: Distance) -> Self {
        let (u, v) = axis.normalize().any_orthonormal_pair();
        let width = half_angle.tan() * axis.length();
        // Not 1 - cos: in f32 that is 0.27 % low for the real sun.
        let one_minus_cos = 2.0 * (0.5 * half_angle).sin().powi(2);
        let spread = Spread::Cone { one_minus_cos, distance };
        Self { axis, u: u * width, v: v * width, outline: Outline::Disk, spread }
    }

    /// Whether all of the light is one point, or one direction.
    pub(crate) fn is_point(&self) -> bool {
        self.u == DVec3::ZERO && self.v == DVec3::ZERO
    }

    /// How much `a x + b y` varies to either side over the light.
    pub(crate) fn reach(&self, a: f64, b: f64) -> f64 {
        match self.outline {
            Outline::Square => a.abs() + b.abs(),
            Outline::Disk => (a * a + b * b).sqrt(),
        }
    }

    /// Smallest and largest nearness on the light.
    pub(crate) fn nearness(&self) -> [f64; 2] {
        match self.spread {
            Spread::Area => [1.0, 1.0],
            Spread::Cone { distance: Distance::Infinite, .. } => [0.0, 0.0],
            // From the middle, 1 / (1 - sin), to the limb, 1 / cos^2.
            Spread::Cone { one_minus_cos, distance: Distance::Sphere } => {
                let cos2 = (1.0 - one_minus_cos).powi(2);
                [1.0 / cos2, 1.0 / (1.0 - (1.0 - cos2).sqrt())]
            }
        }
    }

    /// Whether the light is above the receiver's horizon.
    pub(crate) fn elevation(&self, normal: DVec3) -> Elevation {
        if normal == DVec3::ZERO {
            return Elevation::Above;
        }
        let middle = normal.dot(self.axis);
        let reach = self.reach(normal.dot(self.u), normal.dot(self.v));
        match (middle - reach > 0.0, middle + reach > 0.0) {
            (true, _) => Elevation::Above,
            (false, true) => Elevation::Across,
            (false, false) => Elevation::Below,
        }
    }
}
