//! D1, edge ladder: penumbra width against the gap between blocker and receiver, banding, and
//! whether a kernel treats all directions alike.
//!
//! Plates of 2 x 2 m hang at .1, .3, 1, 3 and 10 m, in three rows: one pair of their edges lies at
//! 0, 22.5 or 45 degrees to the horizontal axis of the sun's shadow map. The shadows fall on a
//! regular grid, apart from each other.

use super::{Mesh, SUN_AZIMUTH_DEGREES, SUN_ELEVATION_DEGREES, above_shadow, floor};
use crate::model::Model;
use glam::{DVec2, DVec3};

/// Height of the plates' lower faces, by column from right to left.
pub(super) const HEIGHTS: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];
/// Angle of an edge to the map's horizontal axis, by row from front to back.
pub(super) const EDGE_DEGREES: [f64; 3] = [0.0, 22.5, 45.0];
/// Half a plate: its faces are thin enough that both silhouettes have the same gap within 4 %
/// (at .1 m), thick enough not to be missed by a depth bias of a millimetre.
const HALF_PLATE: DVec3 = DVec3::new(1.0, 0.002, 1.0);
/// Between the centres of shadows; a turned plate with its penumbra is 3.4 m wide.
const SPACING: f64 = 3.5;

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 10.0);
    let paints =
        [[0.80, 0.33, 0.22], [0.86, 0.62, 0.22], [0.45, 0.62, 0.35], [0.28, 0.52, 0.66], [0.45, 0.38, 0.62]];
    for (column, (height, albedo)) in HEIGHTS.into_iter().zip(paints).enumerate() {
        let paint = model.paint(&format!("plate at {height} m"), albedo);
        for (row, degrees) in EDGE_DEGREES.into_iter().enumerate() {
            let shadow = DVec2::new(2.0 - column as f64, 1.0 - row as f64) * SPACING;
            let centre = above_shadow(shadow, height) + DVec3::Y * HALF_PLATE.y;
            let mesh = Mesh::turned_cuboid(centre, HALF_PLATE, plate_azimuth(degrees.to_radians()));
            model.add(format!("plate {height} m, {degrees} degrees"), paint, mesh);
        }
    }
    model
}

/// How far to turn a level plate so that its first edge has this angle in the sun's map. The map's
/// horizontal axis is level and square to the sun's azimuth; level lengths along the azimuth are
/// foreshortened by the sine of the elevation.
fn plate_azimuth(in_map: f64) -> f64 {
    let on_floor = (in_map.tan() / SUN_ELEVATION_DEGREES.to_radians().sin()).atan();
    SUN_AZIMUTH_DEGREES.to_radians() + std::f64::consts::FRAC_PI_2 + on_floor
}
