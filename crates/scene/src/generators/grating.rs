//! D4, grating: bars of 2 cm every 6 cm over 3 x 3 m, tilted so that they hang 2 cm above the floor
//! at one end and half a metre at the other. Moire between bars, texels and pixels; shadows of
//! single bars that widen until they touch their neighbours; detail that a checkerboard skips.
//!
//! Three of them side by side, turned outwards: a low camera before the middle looks along the bars of
//! all, and so between them.

use super::{Mesh, Paint, floor};
use crate::model::Model;
use glam::{DAffine3, DVec3};
use std::f64::consts::FRAC_PI_2;

/// Side of a bar's square section, and between the axes of bars.
pub(super) const BAR: f64 = 0.02;
pub(super) const PITCH: f64 = 0.06;
/// 50 bars, each in its own pitch of the 3 m.
pub(super) const BARS: usize = 50;
/// Length of a bar, and of the square's side.
pub(super) const SIDE: f64 = 3.0;
/// Of the lower edge of a bar above the floor, at its two ends.
pub(super) const HEIGHTS: [f64; 2] = [0.02, 0.5];
/// How far the bars of each grating are turned, from z towards x; by grating, from +x.
pub(super) const TURNED_DEGREES: [f64; 3] = [22.5, 0.0, -45.0];
/// Between the middles of gratings: the diagonal of one is 4.2 m.
const SPACING: f64 = 4.3;

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 10.0);
    let paints = [[0.24, 0.34, 0.42], [0.44, 0.30, 0.20], [0.26, 0.38, 0.26]];
    for (k, (degrees, albedo)) in TURNED_DEGREES.into_iter().zip(paints).enumerate() {
        let paint = model.paint(&format!("bars at {degrees} degrees"), albedo);
        let middle = DVec3::new((1.0 - k as f64) * SPACING, 0.0, -1.0);
        let turn = DAffine3::from_rotation_y(degrees.to_radians());
        grating(&mut model, (paint, degrees), DAffine3::from_translation(middle) * turn);
    }
    model
}

/// Bars along z of the grating's own frame, which rise with it.
fn grating(model: &mut Model, (paint, degrees): (Paint, f64), world_from_grating: DAffine3) {
    let tilt = ((HEIGHTS[1] - HEIGHTS[0]) / SIDE).asin();
    for k in 0..BARS {
        let x = (k as f64 - 0.5 * (BARS - 1) as f64) * PITCH;
        let foot = DVec3::new(x, HEIGHTS[0], -0.5 * SIDE * tilt.cos());
        // The bar's own x runs along it, its lower edge from the origin.
        let tilted = DAffine3::from_rotation_y(-FRAC_PI_2) * DAffine3::from_rotation_z(tilt);
        let bar = Mesh::cuboid(DVec3::new(0.0, 0.0, -0.5 * BAR), DVec3::new(SIDE, BAR, 0.5 * BAR));
        let placed = bar.placed(world_from_grating * DAffine3::from_translation(foot) * tilted);
        model.add(format!("bar {k} at {degrees} degrees"), paint, placed);
    }
}
