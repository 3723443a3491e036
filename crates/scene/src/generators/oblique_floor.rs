//! D6, oblique floor: 100 columns on a floor of 60 x 60 m, half of them with capitals, to be seen
//! at grazing angles, where a mask of low resolution is undersampled and swims.

use super::{Mesh, floor};
use crate::model::Model;
use glam::DVec3;

/// Columns per side of the square.
pub(super) const SIDE: usize = 10;
pub(super) const PITCH: f64 = 5.0;
pub(super) const RADIUS: f64 = 0.25;
pub(super) const HEIGHT: f64 = 4.0;
/// Half width and height of a capital; it ends at the column's height.
const CAPITAL: (f64, f64) = (0.45, 0.35);

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 30.0);
    let paints = [model.paint("sandstone", [0.70, 0.56, 0.38]), model.paint("granite", [0.50, 0.51, 0.54])];
    for (i, k) in (0..SIDE).flat_map(|i| (0..SIDE).map(move |k| (i, k))) {
        let place = |index: usize| (index as f64 - 0.5 * (SIDE - 1) as f64) * PITCH;
        let at = |y: f64| DVec3::new(place(i), y, place(k));
        let has_capital = (i + k) % 2 == 0;
        let paint = paints[usize::from(has_capital)];
        let shaft_top = if has_capital { HEIGHT - CAPITAL.1 } else { HEIGHT };
        model.add(format!("column {i} {k}"), paint, Mesh::cylinder(at(0.0), at(shaft_top), RADIUS, 32));
        if has_capital {
            let half = DVec3::new(CAPITAL.0, 0.0, CAPITAL.0);
            let capital = Mesh::cuboid(at(shaft_top) - half, at(HEIGHT) + half);
            model.add(format!("capital {i} {k}"), paint, capital);
        }
    }
    model
}
