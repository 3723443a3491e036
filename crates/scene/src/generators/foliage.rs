//! D7, foliage: 400 leaves of 12 cm in a ball of 4 m, 1 to 5 m above the floor, round a trunk. Their
//! shadow is a pattern of small soft holes at every blocker distance: noise, shimmer, and variance
//! that a moment map cannot hold.
//!
//! Places and turns come from integers alone, and from operations that IEEE 754 rounds exactly, so
//! that the tree is the same on every machine.

use super::{Mesh, above_shadow, floor};
use crate::model::Model;
use glam::{DVec2, DVec3};

pub(super) const LEAVES: usize = 400;
/// Side of a leaf, which is square.
pub(super) const LEAF: f64 = 0.12;
/// Of the ball that holds the leaves' middles.
pub(super) const CROWN_RADIUS: f64 = 2.0;
pub(super) const CROWN_HEIGHT: f64 = 3.0;
/// Middle of the crown's shadow on the floor.
const SHADOW: DVec2 = DVec2::new(0.0, -1.0);
/// The trunk ends inside the crown.
pub(super) const TRUNK_RADIUS: f64 = 0.1;
const TRUNK_HEIGHT: f64 = 3.6;

pub(super) fn model() -> Model {
    let mut model = Model::default();
    floor(&mut model, 10.0);
    let crown = above_shadow(SHADOW, CROWN_HEIGHT);
    let bark = model.paint("bark", [0.32, 0.24, 0.17]);
    let trunk = Mesh::cylinder(crown.with_y(0.0), crown.with_y(TRUNK_HEIGHT), TRUNK_RADIUS, 32);
    model.add("trunk", bark, trunk);
    let paints = [model.paint("leaves", [0.22, 0.42, 0.14]), model.paint("young leaves", [0.40, 0.52, 0.18])];
    let mut dice = Dice(1);
    for k in 0..LEAVES {
        let middle = crown + dice.in_ball() * CROWN_RADIUS;
        model.add(format!("leaf {k}"), paints[k % 2], leaf(middle, &mut dice));
    }
    model
}

/// A square that faces anywhere, turned anyhow.
fn leaf(middle: DVec3, dice: &mut Dice) -> Mesh {
    let facing = dice.in_ball().normalize();
    let along = dice.in_ball().reject_from(facing).normalize();
    let across = facing.cross(along);
    Mesh::sheet(1, 1, |u, v| middle + ((u - 0.5) * along + (v - 0.5) * across) * LEAF)
}

/// PCG-RXS-M-XS 32 (O'Neill 2014): a counter of 32 bits, well mixed.
struct Dice(u32);

impl Dice {
    fn throw(&mut self) -> u32 {
        let state = self.0;
        self.0 = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = (state >> ((state >> 28) + 4) ^ state).wrapping_mul(277_803_737);
        word >> 22 ^ word
    }

    /// In the unit ball, evenly; never so close to its middle that a direction were lost.
    fn in_ball(&mut self) -> DVec3 {
        loop {
            // Exact: 32 bits scaled by a power of two, -1 to below 1.
            let [x, y, z] = [(); 3].map(|()| f64::from(self.throw()) / f64::from(1u32 << 31) - 1.0);
            let at = DVec3::new(x, y, z);
            if (1e-6..=1.0).contains(&at.length_squared()) {
                return at;
            }
        }
    }
}
