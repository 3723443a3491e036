//! Sample points on the light, for one receiver: several independent scrambles side by side.
//!
//! Plain arrays of f32 and loops without branches, which compile to SIMD; only additions,
//! multiplications, divisions and square roots, which give the same bits on every machine.

use crate::aim::{Aim, Distance, Outline, Spread};
use crate::owen::{Sobol, fold};
use glam::{DVec3, Vec3};
use std::f32::consts::FRAC_PI_4;
use std::ops::Range;
use umbrage_scene::AreaLight;

/// Samples are handled this many at a time; the arrays are padded to a multiple.
pub(crate) const LANES: usize = 32;

/// Which scrambles a receiver gets.
pub(crate) struct Layout {
    sobol: Sobol,
    /// Replicates, split over the two halves: even.
    pub(crate) replicates: usize,
    /// Samples of each replicate.
    pub(crate) per_replicate: usize,
    /// Samples of the basis estimate.
    pub(crate) basis: usize,
}

/// The samples of one receiver: the replicates, the basis, padding.
#[derive(Default)]
pub(crate) struct LightSamples {
    pub(crate) x: Vec<f32>,
    pub(crate) y: Vec<f32>,
    pub(crate) nearness: Vec<f32>,
}

impl Layout {
    pub(crate) fn new(replicates: usize, per_replicate: usize, basis: usize) -> Self {
        let sobol = Sobol::new(per_replicate.max(basis) as u32);
        Self { sobol, replicates, per_replicate, basis }
    }

    /// All samples without padding.
    pub(crate) fn len(&self) -> usize {
        self.replicates * self.per_replicate + self.basis
    }

    /// Where each replicate's samples stand, then the basis'.
    pub(crate) fn sets(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let n = self.per_replicate;
        let first_of_basis = self.replicates * n;
        let replicates = (0..self.replicates).map(move |k| k * n..(k + 1) * n);
        replicates.chain(std::iter::once(first_of_basis..first_of_basis + self.basis))
    }

    /// Draws every set for one receiver.
    pub(crate) fn fill(&self, samples: &mut LightSamples, aim: &Aim, seed: u64) {
        let padded = self.len().next_multiple_of(LANES);
        samples.x.resize(padded, 0.0);
        samples.y.resize(padded, 0.0);
        for (k, set) in self.sets().enumerate() {
            self.sobol.scramble(seed ^ k as u64, &mut samples.x[set.clone()], &mut samples.y[set]);
        }
        samples.spread(aim);
    }
}

impl LightSamples {
    /// The place of a sample on a light that is not a sun, or its direction, from the receiver.
    pub(crate) fn direction(&self, aim: &Aim, sample: usize) -> DVec3 {
        aim.axis + f64::from(self.x[sample]) * aim.u + f64::from(self.y[sample]) * aim.v
    }

    /// Replaces all samples by one, given in the unit square.
    pub(crate) fn set_one(&mut self, aim: &Aim, [x, y]: [f32; 2]) {
        self.x.clear();
        self.y.clear();
        self.x.push(x);
        self.y.push(y);
        self.spread(aim);
    }

    /// Replaces all samples by one, given in the aim's coordinates.
    pub(crate) fn set_place(&mut self, aim: &Aim, [x, y]: [f32; 2]) {
        self.x.clear();
        self.y.clear();
        self.nearness.clear();
        self.x.push(x);
        self.y.push(y);
        self.nearness.push(match aim.spread {
            Spread::Cone { one_minus_cos, distance: Distance::Sphere } => {
                // Of the tangent plane: tan^2 of the sample's angle is that of the rim times r^2.
                let [x, y] = [f64::from(x), f64::from(y)];
                let cos2 = (1.0 - one_minus_cos).powi(2);
                let cos2_here = 1.0 / (1.0 + (x * x + y * y) * (1.0 - cos2) / cos2);
                let cos = cos2_here.sqrt();
                (1.0 / (cos * (cos - (cos2_here - cos2).max(0.0).sqrt()))) as f32
            }
            _ => 1.0,
        });
    }

    /// From the unit square onto the light.
    fn spread(&mut self, aim: &Aim) {
        match aim.outline {
            Outline::Square => square(&mut self.x, &mut self.y),
            Outline::Disk => disk(&mut self.x, &mut self.y),
        }
        self.nearness.clear();
        match aim.spread {
            Spread::Area => self.nearness.resize(self.x.len(), 1.0),
            Spread::Cone { one_minus_cos, distance } => {
                self.nearness.resize(self.x.len(), 0.0);
                self.cone(one_minus_cos as f32, distance);
            }
        }
    }

    /// From a uniform disk to the tangent plane of a cone, uniform by solid angle.
    fn cone(&mut self, widest: f32, distance: Distance) {
        // The rim stays where it is: sin / cos of the half angle.
        let rim = (widest * (2.0 - widest)).sqrt() / (1.0 - widest);
        let width = if rim > 0.0 { widest.sqrt() / rim } else { 0.0 };
        for ((x, y), nearness) in self.x.iter_mut().zip(&mut self.y).zip(&mut self.nearness) {
            // q = 1 - cos of the sample's angle from the axis, uniform in [0, widest].
            let q = ((*x * *x + *y * *y) * widest).min(widest);
            let cos = 1.0 - q;
            let scale = width * (2.0 - q).sqrt() / cos;
            *x *= scale;
            *y *= scale;
            if distance == Distance::Sphere {
                // cos - sqrt(sin^2 of the half angle - sin^2 of the sample's), without cancellation.
                *nearness = 1.0 / (cos * (cos - ((widest - q) * (2.0 - widest - q)).sqrt()));
            }
        }
    }
}

fn square(x: &mut [f32], y: &mut [f32]) {
    for axis in [x, y] {
        for c in axis {
            *c = 2.0 * *c - 1.0;
        }
    }
}

/// The concentric map (Shirley and Chiu 1997).
fn disk(x: &mut [f32], y: &mut [f32]) {
    for (x, y) in x.iter_mut().zip(y) {
        let (a, b) = (2.0 * *x - 1.0, 2.0 * *y - 1.0);
        let steep = b.abs() > a.abs();
        let (radius, other) = if steep { (b, a) } else { (a, b) };
        let safe = if radius == 0.0 { 1.0 } else { radius };
        let [sin, cos] = sin_cos(FRAC_PI_4 * (other / safe));
        (*x, *y) = if steep { (radius * sin, radius * cos) } else { (radius * cos, radius * sin) };
    }
}

/// Taylor's series: on [-pi/4, pi/4] the first terms left out are below 2e-9 and 3e-8, under f32's
/// rounding of 6e-8.
fn sin_cos(t: f32) -> [f32; 2] {
    let s = t * t;
    let sin = t * (1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362_880.0)))));
    let cos = 1.0 + s * (-0.5 + s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s * (1.0 / 40_320.0))));
    [sin, cos]
}

/// The seed of everything that is drawn for one light.
pub(crate) fn light_seed(global: u64, light: &AreaLight) -> u64 {
    let words = light.content_hash();
    fold(global, words.as_chunks::<4>().0.iter().map(|&bytes| u32::from_le_bytes(bytes)))
}

/// A receiver's seed: of its place, not of its index, so that its truth does not depend on the
/// company it is asked for in.
pub(crate) fn seed(light_seed: u64, position: Vec3) -> u64 {
    fold(light_seed, (position + Vec3::ZERO).to_array().map(f32::to_bits))
}
