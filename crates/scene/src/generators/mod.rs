//! Procedural scenes: the standard suite. Every length is in metres, y is up, the floor's top lies
//! at y = 0. The light is not part of a generator, but blockers are placed so that their shadows
//! under the suite's sun (elevation 50 degrees, azimuth 30) lie where the cameras look; only the
//! room of D10 is lit by a lamp.

mod colonnade;
mod contact;
mod curved_receivers;
mod edge_ladder;
mod foliage;
mod grating;
mod mesh;
mod oblique_floor;
mod point_light_room;
mod stacked_blockers;
#[cfg(test)]
mod tests;
mod thin_poles;

use crate::model::Model;
use glam::{DVec2, DVec3};
use mesh::{Mesh, Paint};
use serde::{Deserialize, Serialize};

/// A scene made by code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Generator {
    /// Plates at .1, .3, 1, 3 and 10 m: penumbra width against gap, at three angles to the map.
    EdgeLadder,
    /// Boxes, balls and a ramp that touch the floor or hang millimetres above it: biases.
    Contact,
    /// Level and upright poles of 5 mm to 5 cm radius: blockers that a search misses.
    ThinPoles,
    /// Bars of 2 cm every 6 cm, 2 to 50 cm above the floor: moire and fine detail.
    Grating,
    /// Blockers above each other, and stairs under two plates: light leaks.
    StackedBlockers,
    /// A hundred columns on a wide floor: undersampling at grazing angles.
    ObliqueFloor,
    /// Four hundred leaves round a trunk: shadows that are all penumbra.
    Foliage,
    /// A court with colonnades, drapes close to a wall and poles high above it.
    Colonnade,
    /// A torus, a ball, steps and a slope that the sun grazes, with poles above them.
    CurvedReceivers,
    /// A closed room with a chair round its lamp: cube maps and perspective depth.
    PointLightRoom,
}

impl Generator {
    pub(crate) fn model(self) -> Model {
        match self {
            Self::EdgeLadder => edge_ladder::model(),
            Self::Contact => contact::model(),
            Self::ThinPoles => thin_poles::model(),
            Self::Grating => grating::model(),
            Self::StackedBlockers => stacked_blockers::model(),
            Self::ObliqueFloor => oblique_floor::model(),
            Self::Foliage => foliage::model(),
            Self::Colonnade => colonnade::model(),
            Self::CurvedReceivers => curved_receivers::model(),
            Self::PointLightRoom => point_light_room::model(),
        }
    }
}

/// Elevation of the suite's sun.
const SUN_ELEVATION_DEGREES: f64 = 50.0;
/// Azimuth of the suite's sun, from +x towards +z.
const SUN_AZIMUTH_DEGREES: f64 = 30.0;

/// Where something must hang so that the suite's sun casts its shadow on this point of the floor.
fn above_shadow(floor: DVec2, height: f64) -> DVec3 {
    let azimuth = DVec2::from_angle(SUN_AZIMUTH_DEGREES.to_radians());
    let at = floor + azimuth * (height / SUN_ELEVATION_DEGREES.to_radians().tan());
    DVec3::new(at.x, height, at.y)
}

/// A slab whose top is the plane y = 0, square, centred. Its edges stay inside the shadow map of
/// the scene at any azimuth of the light.
fn floor(model: &mut Model, half_width: f64) {
    let paint = model.paint("floor", [0.62, 0.60, 0.56]);
    let lo = DVec3::new(-half_width, -0.2, -half_width);
    model.add("floor", paint, Mesh::cuboid(lo, DVec3::new(half_width, 0.0, half_width)));
}
