//! D10, point-light room: a closed room of 6 x 4 x 3 m with a lamp in its middle and round the lamp
//! the frame of a large chair. Its legs, slats and arms, and their shadows on floor, walls and
//! ceiling, cross the faces of a cube map round the lamp: seams, and the formulas of perspective
//! depth.
//!
//! The lamp itself is a light of the scene file, not a surface.

use super::{Mesh, Paint};
use crate::model::Model;
use glam::{DAffine3, DVec3};

/// Half the inner size along x and z, and the inner height.
pub(super) const ROOM: DVec3 = DVec3::new(3.0, 3.0, 2.0);
/// Of the walls.
const THICKNESS: f64 = 0.2;

/// Half the width and depth of the chair, between the axes of its legs.
const HALF: f64 = 0.6;
/// So that legs do not stand on the planes between the faces of a cube, but cross them.
const TURNED_DEGREES: f64 = 12.0;
const LEG_RADIUS: f64 = 0.03;
pub(super) const SEAT_HEIGHT: f64 = 0.6;
const SEAT_SLATS: usize = 7;
const ARM_HEIGHT: f64 = 1.1;
pub(super) const BACK_HEIGHT: f64 = 2.2;
const BACK_SLATS: [f64; 4] = [0.9, 1.25, 1.6, 1.95];

pub(super) fn model() -> Model {
    let mut model = Model::default();
    room(&mut model);
    let chair = Chair {
        paint: model.paint("beech", [0.62, 0.44, 0.26]),
        // From x towards z.
        world_from_chair: DAffine3::from_rotation_y(-f64::to_radians(TURNED_DEGREES)),
    };
    chair.legs(&mut model);
    chair.seat(&mut model);
    chair.back_and_arms(&mut model);
    model
}

/// Six slabs. The walls along x end where the walls along z begin; floor and ceiling cover both.
fn room(model: &mut Model) {
    let DVec3 { x, y, z } = ROOM;
    let (outer_x, outer_z) = (x + THICKNESS, z + THICKNESS);
    let mut slab = |name: &str, albedo: [f32; 3], lo: [f64; 3], hi: [f64; 3]| {
        let paint = model.paint(name, albedo);
        model.add(name, paint, Mesh::cuboid(lo.into(), hi.into()));
    };
    slab("floor", [0.62, 0.60, 0.56], [-outer_x, -THICKNESS, -outer_z], [outer_x, 0.0, outer_z]);
    slab("ceiling", [0.78, 0.78, 0.76], [-outer_x, y, -outer_z], [outer_x, y + THICKNESS, outer_z]);
    slab("wall +x", [0.66, 0.56, 0.50], [x, 0.0, -outer_z], [outer_x, y, outer_z]);
    slab("wall -x", [0.50, 0.58, 0.66], [-outer_x, 0.0, -outer_z], [-x, y, outer_z]);
    slab("wall +z", [0.66, 0.64, 0.52], [-x, 0.0, z], [x, y, outer_z]);
    slab("wall -z", [0.56, 0.64, 0.56], [-x, 0.0, -outer_z], [x, y, -z]);
}

/// In its own frame it stands on y = 0 over the origin and faces +x.
struct Chair {
    paint: Paint,
    world_from_chair: DAffine3,
}

impl Chair {
    fn add(&self, model: &mut Model, name: String, part: Mesh) {
        model.add(name, self.paint, part.placed(self.world_from_chair));
    }

    /// Those in front carry the arms, those behind the back.
    fn legs(&self, model: &mut Model) {
        for (side, z) in [("+z", HALF), ("-z", -HALF)] {
            for (end, x, top) in [("front", HALF, ARM_HEIGHT), ("rear", -HALF, BACK_HEIGHT)] {
                let at = |y: f64| DVec3::new(x, y, z);
                let leg = Mesh::cylinder(at(0.0), at(top), LEG_RADIUS, 32);
                self.add(model, format!("{end} leg {side}"), leg);
            }
        }
    }

    /// Two rails from front to back, and slats across them.
    fn seat(&self, model: &mut Model) {
        for (side, z) in [("+z", HALF), ("-z", -HALF)] {
            let at = |x: f64| DVec3::new(x, SEAT_HEIGHT - 0.02, z);
            let rail = Mesh::cylinder(at(LEG_RADIUS - HALF), at(HALF - LEG_RADIUS), 0.02, 24);
            self.add(model, format!("rail {side}"), rail);
        }
        for k in 0..SEAT_SLATS {
            let x = (k as f64 - 0.5 * (SEAT_SLATS - 1) as f64) * 0.16;
            let half = DVec3::new(0.03, 0.01, HALF);
            let middle = DVec3::new(x, SEAT_HEIGHT + half.y, 0.0);
            self.add(model, format!("seat slat {k}"), Mesh::cuboid(middle - half, middle + half));
        }
    }

    fn back_and_arms(&self, model: &mut Model) {
        for y in BACK_SLATS {
            let half = DVec3::new(0.01, 0.04, HALF - LEG_RADIUS);
            let middle = DVec3::new(-HALF, y, 0.0);
            self.add(model, format!("back slat at {y} m"), Mesh::cuboid(middle - half, middle + half));
        }
        for (side, z) in [("+z", HALF), ("-z", -HALF)] {
            let lo = DVec3::new(LEG_RADIUS - HALF, ARM_HEIGHT, z - 0.04);
            let hi = DVec3::new(HALF + 0.08, ARM_HEIGHT + 0.03, z + 0.04);
            self.add(model, format!("arm {side}"), Mesh::cuboid(lo, hi));
        }
    }
}
