//! D5, stacked blockers: what a shadow map with one layer cannot know.
//!
//! In front, three plates with a hole hang at 8 m; a bar crosses each patch of light close to the
//! floor, at 0, 45 and 90 degrees: its hard shadow meets the plate's soft one. Behind, the leak rig: two plates one metre apart,
//! overlapping by half as the sun sees them, over stairs .1, .25, .5, 1 and 2 m below the lower
//! one. With a, b, c the depths of upper plate, lower plate and stair, t = (c - a) / (b - a) is
//! 1.1, 1.25, 1.5, 2 and 3: a variance shadow map leaks most below t = 1.6.

use super::{Mesh, above_shadow, floor};
use crate::model::Model;
use glam::{DVec2, DVec3};

/// The middle of each light patch, and how far the bar across it is turned from x towards z.
const PATCHES: [(DVec2, f64); 3] =
    [(DVec2::new(4.2, -3.6), 0.0), (DVec2::new(0.0, -3.6), 45.0), (DVec2::new(-4.2, -3.6), 90.0)];
pub(super) const PLATE_HEIGHT: f64 = 8.0;
const PLATE_HALF_WIDTH: f64 = 1.5;
const HOLE_HALF_WIDTH: f64 = 0.5;
pub(super) const BAR_HEIGHT: f64 = 0.3;
/// Thin; .6 m wide, where the hole is 1 m.
const BAR_HALF: DVec3 = DVec3::new(1.3, 0.025, 0.3);

/// How far each stair lies below the top of the lower plate, from -x to +x.
pub(super) const STAIRS_BELOW: [f64; 5] = [0.1, 0.25, 0.5, 1.0, 2.0];
pub(super) const LOWER_TOP: f64 = 2.0;
pub(super) const UPPER_TOP: f64 = 3.0;
const STAIR_WIDTH: f64 = 1.1;
/// The stairs' first edge, and the middle of the lower plate.
const RIG: DVec2 = DVec2::new(-2.75, 1.2);
/// Of both plates; along x they reach far enough to shade every stair over its whole width.
const RIG_PLATE_HALF: DVec3 = DVec3::new(4.2, 0.005, 0.3);

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 10.0);
    holes_and_bars(&mut model);
    leak_rig(&mut model);
    model
}

fn holes_and_bars(model: &mut Model) {
    let steel = model.paint("plate with a hole", [0.30, 0.45, 0.62]);
    let orange = model.paint("bar", [0.78, 0.36, 0.20]);
    for (patch, degrees) in PATCHES {
        let middle = above_shadow(patch, PLATE_HEIGHT);
        for (side, mesh) in plate_with_hole(middle) {
            model.add(format!("plate over the bar at {degrees} degrees, {side}"), steel, mesh);
        }
        let centre = above_shadow(patch, BAR_HEIGHT) + DVec3::Y * BAR_HALF.y;
        let bar = Mesh::turned_cuboid(centre, BAR_HALF, f64::to_radians(degrees));
        model.add(format!("bar at {degrees} degrees"), orange, bar);
    }
}

/// Four boxes round a hole; the middle lies in their lower faces.
fn plate_with_hole(middle: DVec3) -> [(&'static str, Mesh); 4] {
    let (inner, thickness) = (HOLE_HALF_WIDTH, 0.02);
    let rim = 0.5 * (PLATE_HALF_WIDTH - inner);
    let part = |direction: DVec3, half: DVec3| {
        let centre = middle + direction * (inner + rim) + DVec3::Y * thickness;
        Mesh::cuboid(centre - half, centre + half)
    };
    let whole = DVec3::new(rim, thickness, PLATE_HALF_WIDTH);
    let between = DVec3::new(inner, thickness, rim);
    [
        ("+x", part(DVec3::X, whole)),
        ("-x", part(DVec3::NEG_X, whole)),
        ("+z", part(DVec3::Z, between)),
        ("-z", part(DVec3::NEG_Z, between)),
    ]
}

fn leak_rig(model: &mut Model) {
    let stone = model.paint("stairs", [0.66, 0.62, 0.52]);
    for (k, below) in STAIRS_BELOW.into_iter().enumerate() {
        let x = RIG.x + k as f64 * STAIR_WIDTH;
        let top = LOWER_TOP - below;
        // The last stair is the floor itself.
        if top > 0.0 {
            let lo = DVec3::new(x, 0.0, RIG.y - 1.2);
            let hi = DVec3::new(x + STAIR_WIDTH, top, RIG.y + 0.6);
            model.add(format!("stair {below} m below"), stone, Mesh::cuboid(lo, hi));
        }
    }
    let paint = model.paint("rig plates", [0.42, 0.55, 0.35]);
    // Where the sun sees it on the lower plate's plane, the upper one is half a width nearer.
    let lower = DVec2::new(RIG.x + 3.5, RIG.y);
    let upper = above_shadow(lower - DVec2::Y * RIG_PLATE_HALF.z, UPPER_TOP - LOWER_TOP);
    let lower = DVec3::new(lower.x, LOWER_TOP, lower.y);
    for (name, top) in [("lower plate", lower), ("upper plate", upper + DVec3::Y * LOWER_TOP)] {
        let centre = top - DVec3::Y * RIG_PLATE_HALF.y;
        model.add(name, paint, Mesh::cuboid(centre - RIG_PLATE_HALF, centre + RIG_PLATE_HALF));
    }
}
