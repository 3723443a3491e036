//! D2, contact: what a bias does to shadows of things that stand on the floor or barely above it.
//! Acne, shadows that part from their feet (peter-panning), and hardening towards the contact.
//!
//! Behind, boxes of 1 m touch the floor or hang 1, 5 and 20 mm above it, once square to the scene
//! and once turned. In front: a slab of 5 cm, balls of 25 cm radius that touch the floor in a point,
//! and a ramp of 15 degrees with a box and a pole on it.
//! Foremost, posts of 2 m, raised like the boxes: their shadows soften from foot to top.

use super::{Mesh, Paint, floor};
use crate::model::Model;
use glam::{DAffine3, DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// How high a box hangs above the floor, by column from +x.
pub(super) const RAISED: [f64; 4] = [0.0, 0.001, 0.005, 0.020];
/// Side of a box.
pub(super) const BOX: f64 = 1.0;
/// z of a row of boxes, and how far they are turned from x towards z: by 45 degrees the sun grazes a
/// side that the cameras see, at 10 degrees.
pub(super) const ROWS: [(f64, f64); 2] = [(0.0, 0.0), (2.2, 45.0)];
/// Between the middles of boxes: a turned box and its shadow are 2.2 m wide.
const SPACING: f64 = 2.3;

/// Height and half width of a post, and the first of their row; they are raised as the boxes are.
pub(super) const POST: (f64, f64) = (2.0, 0.1);
const FIRST_POST: DVec2 = DVec2::new(4.0, -3.3);

/// Middle of the slab, and half its sides; its height is 5 cm.
const SLAB: (DVec2, DVec2) = (DVec2::new(3.0, -2.0), DVec2::new(0.8, 0.5));
pub(super) const SLAB_HEIGHT: f64 = 0.05;
pub(super) const BALL_RADIUS: f64 = 0.25;
const BALLS: [DVec2; 3] = [DVec2::new(1.4, -2.2), DVec2::new(0.6, -1.6), DVec2::new(0.2, -2.5)];

/// The ramp rises away from the cameras and towards the sun, which its face is turned away from.
pub(super) const RAMP_DEGREES: f64 = 15.0;
/// Level length and half width of the ramp, and the middle of its lower edge.
const RAMP: (f64, f64) = (2.0, 1.3);
const RAMP_FOOT: DVec2 = DVec2::new(-2.3, -3.0);
/// Half the side of the box on the ramp.
pub(super) const RAMP_BOX_HALF: f64 = 0.2;

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 10.0);
    boxes(&mut model);
    posts(&mut model);
    low_things(&mut model);
    ramp(&mut model);
    model
}

fn boxes(model: &mut Model) {
    let paint = model.paint("boxes", [0.62, 0.40, 0.26]);
    for (z, degrees) in ROWS {
        for (column, raised) in RAISED.into_iter().enumerate() {
            let centre = DVec3::new((1.5 - column as f64) * SPACING, raised + 0.5 * BOX, z);
            let mesh = Mesh::turned_cuboid(centre, DVec3::splat(0.5 * BOX), degrees.to_radians());
            model.add(format!("box {raised} m above, {degrees} degrees"), paint, mesh);
        }
    }
}

fn posts(model: &mut Model) {
    let paint = model.paint("posts", [0.46, 0.30, 0.44]);
    let (height, half) = POST;
    for (column, raised) in RAISED.into_iter().enumerate() {
        let foot = DVec3::new(FIRST_POST.x - column as f64 * SPACING, raised, FIRST_POST.y);
        let (lo, hi) = (DVec3::new(-half, 0.0, -half), DVec3::new(half, height, half));
        model.add(format!("post {raised} m above"), paint, Mesh::cuboid(foot + lo, foot + hi));
    }
}

fn low_things(model: &mut Model) {
    let slate = model.paint("slab", [0.34, 0.40, 0.46]);
    let (middle, half) = SLAB;
    let corner = |side: f64, y: f64| DVec3::new(middle.x + side * half.x, y, middle.y + side * half.y);
    model.add("slab", slate, Mesh::cuboid(corner(-1.0, 0.0), corner(1.0, SLAB_HEIGHT)));
    let glazed = model.paint("balls", [0.70, 0.24, 0.20]);
    for (k, at) in BALLS.into_iter().enumerate() {
        let centre = DVec3::new(at.x, BALL_RADIUS, at.y);
        model.add(format!("ball {k}"), glazed, Mesh::sphere(centre, BALL_RADIUS, [24, 48]));
    }
}

/// With a box flat on it and a pole square to it.
fn ramp(model: &mut Model) {
    let paint = model.paint("ramp", [0.58, 0.60, 0.44]);
    let (run, half_width) = RAMP;
    let slope = RAMP_DEGREES.to_radians();
    // Rising along z instead of x.
    let turn = DAffine3::from_rotation_y(-FRAC_PI_2);
    let foot = DAffine3::from_translation(DVec3::new(RAMP_FOOT.x, 0.0, RAMP_FOOT.y)) * turn;
    model.add("ramp", paint, Mesh::wedge(run, run * slope.tan(), half_width).placed(foot));
    on_the_ramp(model, paint, foot * DAffine3::from_rotation_z(slope));
}

/// In the ramp's own frame: x up the slope, y square to it, z to the right of who looks up.
fn on_the_ramp(model: &mut Model, paint: Paint, world_from_ramp: DAffine3) {
    let half = DVec3::splat(RAMP_BOX_HALF);
    let rest = DVec3::new(1.2, RAMP_BOX_HALF, -0.6);
    model.add("box on the ramp", paint, Mesh::cuboid(rest - half, rest + half).placed(world_from_ramp));
    let at = |y: f64| DVec3::new(1.6, y, 0.5);
    let pole = Mesh::cylinder(at(0.0), at(1.0), 0.05, 32);
    model.add("pole on the ramp", paint, pole.placed(world_from_ramp));
}
