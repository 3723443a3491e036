//! D3, thin poles: blockers thinner than the taps of a search are apart. Missed blockers, and
//! penumbrae that end abruptly.
//!
//! Level cylinders of 1, 2 and 5 cm radius at 6 m, along x and along z, and a cable of 5 mm at 4 m;
//! the shadows of upright poles of 8 m cross theirs, hard at the foot and soft at the tip.

use super::{Mesh, above_shadow, floor};
use crate::model::Model;
use glam::{DVec2, DVec3};

/// Radius of a level cylinder at 6 m, z of its shadow when it runs along x, and x of the shadow of
/// its twin that runs along z.
pub(super) const LEVEL: [(f64, f64, f64); 3] = [(0.01, 0.6, 3.2), (0.02, -1.4, 0.8), (0.05, -3.4, -1.6)];
/// Radius of an upright pole, and where it stands.
pub(super) const UPRIGHT: [(f64, DVec2); 6] = [
    (0.01, DVec2::new(6.0, -1.0)),
    (0.02, DVec2::new(5.6, 0.9)),
    (0.05, DVec2::new(5.2, 2.8)),
    (0.01, DVec2::new(2.4, 3.4)),
    (0.02, DVec2::new(0.4, 3.0)),
    (0.05, DVec2::new(-1.6, 2.6)),
];
pub(super) const LEVEL_HEIGHT: f64 = 6.0;
pub(super) const UPRIGHT_HEIGHT: f64 = 8.0;
pub(super) const CABLE_RADIUS: f64 = 0.005;
pub(super) const CABLE_HEIGHT: f64 = 4.0;
/// z of the cable's shadow.
const CABLE_SHADOW: f64 = -2.4;
/// Half the length of everything level.
const HALF_LENGTH: f64 = 5.0;

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 10.0);
    let paint = model.paint("painted steel", [0.55, 0.20, 0.16]);
    for (radius, z, x) in LEVEL {
        let along_x = level([DVec2::new(0.0, z), DVec2::X], LEVEL_HEIGHT, radius);
        model.add(format!("level pole {radius} m along x"), paint, along_x);
        // A pole's width higher: where they cross, they touch and do not overlap.
        let along_z = level([DVec2::new(x, -1.0), DVec2::Y], LEVEL_HEIGHT + 0.1, radius);
        model.add(format!("level pole {radius} m along z"), paint, along_z);
    }
    for (k, (radius, foot)) in UPRIGHT.into_iter().enumerate() {
        let at = |y: f64| DVec3::new(foot.x, y, foot.y);
        let mesh = Mesh::cylinder(at(0.0), at(UPRIGHT_HEIGHT), radius, 32);
        model.add(format!("upright pole {k} {radius} m"), paint, mesh);
    }
    let black = model.paint("cable", [0.10, 0.10, 0.11]);
    let shadow = [DVec2::new(0.0, CABLE_SHADOW), DVec2::X];
    model.add("cable", black, level(shadow, CABLE_HEIGHT, CABLE_RADIUS));
    model
}

/// A level cylinder whose shadow has this middle and direction (x and z).
fn level([middle, direction]: [DVec2; 2], height: f64, radius: f64) -> Mesh {
    let end = |side: f64| above_shadow(middle + direction * (side * HALF_LENGTH), height);
    Mesh::cylinder(end(-1.0), end(1.0), radius, 24)
}
