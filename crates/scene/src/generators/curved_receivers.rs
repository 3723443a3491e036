//! D9, curved receivers: surfaces for which a receiver's plane says little or too much. A torus, a
//! ball, twelve steps, and a slope that the suite's sun grazes at 5 degrees. Biases along the normal
//! or the plane, and moments filtered over more than a plane, fail here first.
//!
//! Level poles at different heights hang between each of them and the sun.

use super::{Mesh, SUN_AZIMUTH_DEGREES, SUN_ELEVATION_DEGREES, above_shadow, floor};
use crate::model::Model;
use glam::{DAffine3, DVec2, DVec3};

/// Radius of the ring and of its tube; it lies on the floor.
pub(super) const TORUS: [f64; 2] = [0.8, 0.3];
const TORUS_AT: DVec2 = DVec2::new(1.3, -2.2);
pub(super) const BALL_RADIUS: f64 = 0.8;
const BALL_AT: DVec2 = DVec2::new(0.0, 0.4);

pub(super) const STEPS: usize = 12;
pub(super) const RISE: f64 = 0.16;
pub(super) const TREAD: f64 = 0.28;
/// The foot of the stairs, which climb towards -x: the sun and the cameras see treads and risers.
const STAIRS_FOOT: DVec2 = DVec2::new(-1.6, -1.0);
const STAIRS_HALF_WIDTH: f64 = 1.2;

/// Between the slope and the sun's rays, which reach it over its ridge.
pub(super) const GRAZING_DEGREES: f64 = 5.0;
/// Length of the slope from foot to ridge, and half its width.
const SLOPE: (f64, f64) = (2.2, 1.3);
const SLOPE_FOOT: DVec2 = DVec2::new(3.4, -1.6);
/// Of the bars over the slope, above it and along it from its foot: at 5 degrees a shadow lies
/// eleven times as far down the slope as its bar hangs above it.
const SLOPE_BARS: [(f64, f64); 2] = [(0.03, 2.05), (0.10, 1.9)];
const SLOPE_BAR_RADIUS: f64 = 0.01;
/// Height of the pins that stand on the slope, and their radius.
const PIN: (f64, f64) = (0.06, 0.03);

/// How much higher than the receiver's top a pole hangs, and its direction.
pub(super) const POLES: [(f64, DVec3); 3] =
    [(0.8, DVec3::X), (1.8, DVec3::new(1.0, 0.0, -1.0)), (3.0, DVec3::Z)];
const POLE_RADIUS: f64 = 0.06;
const POLE_HALF_LENGTH: f64 = 1.6;

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 10.0);
    let clay = model.paint("clay", [0.66, 0.50, 0.40]);
    let [ring, tube] = TORUS;
    let torus = Mesh::torus(DVec3::new(TORUS_AT.x, tube, TORUS_AT.y), [ring, tube], [96, 32]);
    model.add("torus", clay, torus);
    let middle = DVec3::new(BALL_AT.x, BALL_RADIUS, BALL_AT.y);
    model.add("ball", clay, Mesh::sphere(middle, BALL_RADIUS, [48, 96]));
    stairs(&mut model);
    slope(&mut model);
    poles(&mut model);
    model
}

fn stairs(model: &mut Model) {
    let stone = model.paint("steps", [0.60, 0.60, 0.58]);
    for k in 0..STEPS {
        let x = STAIRS_FOOT.x - k as f64 * TREAD;
        let lo = DVec3::new(x - TREAD, 0.0, STAIRS_FOOT.y - STAIRS_HALF_WIDTH);
        let hi = DVec3::new(x, (k + 1) as f64 * RISE, STAIRS_FOOT.y + STAIRS_HALF_WIDTH);
        model.add(format!("step {k}"), stone, Mesh::cuboid(lo, hi));
    }
}

/// It rises towards the sun, a little less steep than the sun's rays: they pass over the ridge and all
/// but miss it.
fn slope(model: &mut Model) {
    let paint = model.paint("slope", [0.48, 0.56, 0.62]);
    let (length, half_width) = SLOPE;
    let rise = (SUN_ELEVATION_DEGREES - GRAZING_DEGREES).to_radians();
    let foot = DAffine3::from_translation(DVec3::new(SLOPE_FOOT.x, 0.0, SLOPE_FOOT.y))
        * DAffine3::from_rotation_y(-SUN_AZIMUTH_DEGREES.to_radians());
    let wedge = Mesh::wedge(length * rise.cos(), length * rise.sin(), half_width);
    model.add("slope", paint, wedge.placed(foot));
    over_the_slope(model, foot * DAffine3::from_rotation_z(rise));
}

/// In the slope's own frame: x up the slope, y square to it.
fn over_the_slope(model: &mut Model, world_from_slope: DAffine3) {
    let brass = model.paint("brass", [0.62, 0.50, 0.22]);
    for (k, (above, along)) in SLOPE_BARS.into_iter().enumerate() {
        let end = |z: f64| DVec3::new(along, above, z);
        let bar = Mesh::cylinder(end(-SLOPE.1), end(SLOPE.1), SLOPE_BAR_RADIUS, 24);
        model.add(format!("slope bar {k}"), brass, bar.placed(world_from_slope));
    }
    let (height, radius) = PIN;
    for k in 0..4 {
        let at = |y: f64| DVec3::new(1.3, y, 0.6 * f64::from(k) - 0.9);
        let pin = Mesh::cylinder(at(0.0), at(height), radius, 24);
        model.add(format!("pin {k}"), brass, pin.placed(world_from_slope));
    }
}

/// Over each receiver three poles, whose shadows cross on it.
fn poles(model: &mut Model) {
    let iron = model.paint("poles", [0.30, 0.22, 0.20]);
    let stairs = STAIRS_FOOT - DVec2::X * (0.5 * STEPS as f64 * TREAD);
    let receivers = [
        ("torus", TORUS_AT, 2.0 * TORUS[1]),
        ("ball", BALL_AT, 2.0 * BALL_RADIUS),
        ("stairs", stairs, 0.5 * STEPS as f64 * RISE),
    ];
    for (name, at, top) in receivers {
        for (higher, along) in POLES {
            let mesh = pole(DVec3::new(at.x, top, at.y), higher, along);
            model.add(format!("pole {higher} m above the {name}"), iron, mesh);
        }
    }
}

/// A level pole between a point and the sun, this much higher than the point.
fn pole(point: DVec3, higher: f64, along: DVec3) -> Mesh {
    let middle = point + above_shadow(DVec2::ZERO, higher);
    let half = along.normalize() * POLE_HALF_LENGTH;
    Mesh::cylinder(middle - half, middle + half, POLE_RADIUS, 32)
}
