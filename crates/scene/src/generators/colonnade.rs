//! D8, colonnade, drapes and high poles: the situation of the first seed document. Drapes hang five
//! centimetres off a sunlit wall (hard shadows); columns stand on the floor (shadows that harden
//! towards the foot); thin poles nine metres up cast shadows so soft that they are barely seen, on
//! the floor and across wall and drapes.
//!
//! The court runs along z. On the left (-x) an arcade of eight columns carries a wall; on the right
//! eight columns carry only a beam, so that the sun from the right reaches floor and wall.

use super::{Mesh, Paint, floor};
use crate::model::Model;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Columns per side, and the distance between their axes.
const COLUMNS: usize = 8;
const BAY: f64 = 2.2;
/// The arcade's wall.
const WALL_BACK: f64 = -3.9;
const WALL_FACE: f64 = -3.4;
const WALL_TOP: f64 = 7.0;
/// Where the arches spring from the columns.
const SPRING: f64 = 2.8;
const ARCH_RADIUS: f64 = 0.8;
const ARCH_STEPS: usize = 16;
/// The row of columns on the right, and the top of the beam on them.
const RIGHT_AXIS: f64 = 3.4;
const BEAM_TOP: f64 = 4.3;
/// Height of the poles' axes.
pub(super) const POLE_HEIGHT: f64 = 9.0;
/// z of a pole across the court, and its radius.
pub(super) const POLES: [(f64, f64); 4] = [(6.0, 0.04), (2.6, 0.06), (-0.6, 0.03), (-3.6, 0.08)];
/// The drapes' mean distance from the wall, and how far their waves go to both sides of it.
const DRAPE_GAP: f64 = 0.05;
const DRAPE_WAVE: f64 = 0.03;

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 10.0);
    let stone = model.paint("stone", [0.68, 0.61, 0.50]);
    arcade(&mut model, stone);
    right_row(&mut model, stone);
    outer_walls(&mut model);
    drapes(&mut model);
    poles(&mut model);
    model
}

fn column_z(k: usize) -> f64 {
    (k as f64 - 0.5 * (COLUMNS - 1) as f64) * BAY
}

fn arcade(model: &mut Model, stone: Paint) {
    let x = 0.5 * (WALL_BACK + WALL_FACE);
    for k in 0..COLUMNS {
        column(model, stone, DVec3::new(x, SPRING, column_z(k)), &format!("left column {k}"));
    }
    let wall = Mesh::wall_between(&arcade_outlines(), WALL_BACK, WALL_FACE);
    model.add("arcade wall", stone, wall);
}

/// Lower and upper outline of the wall: half a bay, then an arch in every bay, then half a bay.
fn arcade_outlines() -> Vec<(DVec2, DVec2)> {
    let end = 0.5 * COLUMNS as f64 * BAY;
    let mut lower = vec![DVec2::new(-end, SPRING)];
    for bay in 0..COLUMNS - 1 {
        let middle = DVec2::new(column_z(bay) + 0.5 * BAY, SPRING);
        lower.extend((0..=ARCH_STEPS).map(|step| {
            let (sin, cos) = (PI * step as f64 / ARCH_STEPS as f64).sin_cos();
            middle + ARCH_RADIUS * DVec2::new(-cos, sin)
        }));
    }
    lower.push(DVec2::new(end, SPRING));
    lower.into_iter().map(|p| (p, DVec2::new(p.x, WALL_TOP))).collect()
}

fn right_row(model: &mut Model, stone: Paint) {
    let beam_bottom = BEAM_TOP - 0.4;
    for k in 0..COLUMNS {
        let top = DVec3::new(RIGHT_AXIS, beam_bottom, column_z(k));
        column(model, stone, top, &format!("right column {k}"));
    }
    let end = 0.5 * COLUMNS as f64 * BAY;
    let beam = Mesh::cuboid(
        DVec3::new(RIGHT_AXIS - 0.25, beam_bottom, -end),
        DVec3::new(RIGHT_AXIS + 0.25, BEAM_TOP, end),
    );
    model.add("beam", stone, beam);
}

/// A column from the floor to the middle of its top face: base, shaft and capital.
fn column(model: &mut Model, paint: Paint, top: DVec3, name: &str) {
    let foot = DVec3::new(top.x, 0.0, top.z);
    let slab = |model: &mut Model, part: &str, middle: DVec3, half: DVec3| {
        model.add(format!("{name} {part}"), paint, Mesh::cuboid(middle - half, middle + half));
    };
    slab(model, "base", foot + DVec3::Y * 0.1, DVec3::new(0.3, 0.1, 0.3));
    slab(model, "capital", top - DVec3::Y * 0.12, DVec3::new(0.3, 0.12, 0.3));
    let shaft = Mesh::cylinder(foot + DVec3::Y * 0.2, top - DVec3::Y * 0.24, 0.2, 32);
    model.add(format!("{name} shaft"), paint, shaft);
}

/// The aisle's rear wall, and the wall that ends the court.
fn outer_walls(model: &mut Model) {
    let paint = model.paint("plaster", [0.72, 0.66, 0.58]);
    let rear = Mesh::cuboid(DVec3::new(-6.4, 0.0, -9.0), DVec3::new(-6.1, 5.0, 9.0));
    model.add("aisle wall", paint, rear);
    let end = Mesh::cuboid(DVec3::new(-6.1, 0.0, -9.3), DVec3::new(4.2, 5.0, -9.0));
    model.add("end wall", paint, end);
}

fn drapes(model: &mut Model) {
    let paints = [
        model.paint("green cloth", [0.18, 0.42, 0.22]),
        model.paint("red cloth", [0.55, 0.13, 0.11]),
        model.paint("blue cloth", [0.16, 0.24, 0.50]),
    ];
    for bay in 0..COLUMNS - 1 {
        let middle = column_z(bay) + 0.5 * BAY;
        model.add(format!("drape {bay}"), paints[bay % 3], drape(middle, bay as f64));
    }
}

/// A cloth in folds before the wall, longer in its middle.
fn drape(middle_z: f64, phase: f64) -> Mesh {
    Mesh::sheet(64, 24, |u, v| {
        let fold = (TAU * 5.0 * u + phase + 0.7 * v).sin();
        let bottom = 4.45 - 0.35 * (PI * u).sin();
        let y = 6.5 + (bottom - 6.5) * v;
        DVec3::new(WALL_FACE + DRAPE_GAP + DRAPE_WAVE * fold, y, middle_z + 0.7 * (1.0 - 2.0 * u))
    })
}

/// Poles across the court on masts, and one along it.
fn poles(model: &mut Model) {
    let paint = model.paint("iron", [0.22, 0.21, 0.20]);
    let left = 0.5 * (WALL_BACK + WALL_FACE);
    for (k, (z, radius)) in POLES.into_iter().enumerate() {
        let at = |x: f64, y: f64| DVec3::new(x, y, z);
        let across =
            Mesh::cylinder(at(left - 0.3, POLE_HEIGHT), at(RIGHT_AXIS + 0.3, POLE_HEIGHT), radius, 24);
        model.add(format!("pole {k}"), paint, across);
        for (side, x, foot) in [("left", left, WALL_TOP), ("right", RIGHT_AXIS, BEAM_TOP)] {
            let mast = Mesh::cylinder(at(x, foot), at(x, POLE_HEIGHT), 0.03, 16);
            model.add(format!("{side} mast {k}"), paint, mast);
        }
    }
    let (first, last) = (POLES[0].0 + 0.5, POLES[POLES.len() - 1].0 - 0.5);
    let end = |z: f64| DVec3::new(0.9, POLE_HEIGHT + 0.15, z);
    model.add("pole along", paint, Mesh::cylinder(end(last), end(first), 0.05, 24));
}
