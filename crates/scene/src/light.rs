//! Area lights. Each emits unit radiance; only shapes and places matter to a shadow.

use glam::Vec3;

/// A light with an extent, hence with penumbrae. A size of zero is allowed: a hard shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AreaLight {
    /// Infinitely far away.
    Sun {
        /// Unit vector from the scene towards the sun's centre.
        direction_to_light: Vec3,
        /// Full angle that its disc subtends.
        angular_diameter_radians: f32,
    },
    /// A flat disc; emits from both sides.
    Disk {
        /// Centre in metres.
        centre: Vec3,
        /// Unit normal.
        normal: Vec3,
        /// Radius in metres.
        radius_world: f32,
    },
    /// A flat parallelogram; emits from both sides.
    Rect {
        /// Centre in metres.
        centre: Vec3,
        /// From the centre to the middle of one side.
        half_u: Vec3,
        /// From the centre to the middle of the next side.
        half_v: Vec3,
    },
    /// A ball.
    Sphere {
        /// Centre in metres.
        centre: Vec3,
        /// Radius in metres.
        radius_world: f32,
    },
}

impl AreaLight {
    /// Unit vector from a point towards the light's centre.
    pub fn direction_from(&self, point: Vec3) -> Vec3 {
        match *self {
            Self::Sun { direction_to_light, .. } => direction_to_light,
            Self::Disk { centre, .. } | Self::Rect { centre, .. } | Self::Sphere { centre, .. } => {
                (centre - point).normalize_or_zero()
            }
        }
    }

    /// Centre of a light that has a place; `None` for a sun.
    pub fn centre(&self) -> Option<Vec3> {
        match *self {
            Self::Sun { .. } => None,
            Self::Disk { centre, .. } | Self::Rect { centre, .. } | Self::Sphere { centre, .. } => {
                Some(centre)
            }
        }
    }

    /// Radius in metres of a light that has a place (of the disc of equal area for a rectangle);
    /// `None` for a sun.
    pub fn radius_world(&self) -> Option<f32> {
        match *self {
            Self::Sun { .. } => None,
            Self::Disk { radius_world, .. } | Self::Sphere { radius_world, .. } => Some(radius_world),
            Self::Rect { half_u, half_v, .. } => {
                Some((4.0 * half_u.cross(half_v).length() / std::f32::consts::PI).sqrt())
            }
        }
    }

    /// Full angle that a sun's disc subtends; `None` for a light that has a place.
    pub fn angular_diameter_radians(&self) -> Option<f32> {
        match *self {
            Self::Sun { angular_diameter_radians, .. } => Some(angular_diameter_radians),
            _ => None,
        }
    }
}
