//! Irradiance from the light with and without shadow: what the picture is scored against.

use crate::aim::{Aim, Outline, Spread};
use crate::receiver::Receiver;
use crate::samples::seed;
use crate::truth::{Scratch, Sight, Task};
use crate::{Points, Tracer, TruthSettings, scanlines};
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};
use umbrage_scene::AreaLight;

/// Per point, for a light of unit radiance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Irradiance {
    /// E: with surfaces in the way. 0 for a light of no size, which has no power.
    pub shadowed: Vec<f32>,
    /// E0: without any. Only the part of the light above the surface's horizon counts.
    pub unshadowed: Vec<f32>,
    /// R = E / E0, 0 to 1, also for a light of no size; 0 where the light is below the horizon. It
    /// is not the visibility: it weights the light by cosines over distance squared.
    pub ratio: Vec<f32>,
}

impl Tracer {
    /// E, E0 and R at points, from the same light samples (both halves) as the truth's mean: `samples` of each, whatever
    /// the tolerance.
    ///
    /// # Panics
    /// When the lists of `points` differ in length: a programming error, never a user's.
    pub fn irradiance(&self, points: &Points, light: &AreaLight, settings: &TruthSettings) -> Irradiance {
        points.check();
        let settings = &TruthSettings { basis_samples: 0, ..*settings };
        let layout = &settings.layout();
        let task = Task::new(self, light, (settings, layout));
        let each: Vec<[f32; 3]> = if settings.method.on_scanlines() {
            scanlines::irradiance(&task, points)
        } else {
            (0..points.len())
                .into_par_iter()
                .with_min_len(64)
                .map_init(Scratch::default, |scratch, index| task.irradiance(points, index, scratch))
                .collect()
        };
        let list = |i: usize| each.iter().map(|e| e[i]).collect();
        Irradiance { shadowed: list(0), unshadowed: list(1), ratio: list(2) }
    }
}

impl Task<'_> {
    /// E, E0 and R of one point.
    pub(crate) fn irradiance(&self, points: &Points, index: usize, scratch: &mut Scratch) -> [f32; 3] {
        let receiver = Receiver::new(&self.tracer.surfaces, points, index);
        let Some(aim) = Aim::new(self.light, &receiver) else { return [0.0; 3] };
        let seed = seed(self.seed, points.position[index]);
        let sight = self.sight(&receiver, &aim, seed, scratch);
        if !matches!(sight, Sight::Sampled) {
            self.layout.fill(&mut scratch.samples, &aim, seed);
        }
        let emitter = Emitter::new(&aim);
        let (mut with, mut without) = (0.0, 0.0);
        for sample in 0..self.layout.len() {
            let weight = emitter.weight(receiver.normal, scratch.samples.direction(&aim, sample));
            let visible = match sight {
                Sight::Lit => true,
                Sight::Hidden => false,
                Sight::Sampled => scratch.cover[sample] < 0.0,
            };
            without += weight;
            with += if visible { weight } else { 0.0 };
        }
        let scale = emitter.size / self.layout.len() as f64;
        let ratio = if without > 0.0 { with / without } else { 0.0 };
        [(with * scale) as f32, (without * scale) as f32, ratio as f32]
    }
}

/// How samples of a light add up to irradiance.
pub(crate) struct Emitter {
    /// Area in m^2 or solid angle in sr.
    pub(crate) size: f64,
    /// A flat light's normal; zero if it has none. `None` for a cone.
    pub(crate) flat: Option<DVec3>,
}

impl Emitter {
    pub(crate) fn new(aim: &Aim) -> Self {
        match aim.spread {
            Spread::Cone { one_minus_cos, .. } => Self { size: TAU * one_minus_cos, flat: None },
            Spread::Area => {
                let cross = aim.u.cross(aim.v);
                let area = match aim.outline {
                    Outline::Square => 4.0,
                    Outline::Disk => PI,
                };
                Self { size: area * cross.length(), flat: Some(cross.normalize_or_zero()) }
            }
        }
    }

    /// Irradiance per [`Emitter::size`] from the place or direction of a sample.
    pub(crate) fn weight(&self, normal: DVec3, to_light: DVec3) -> f64 {
        let square = to_light.length_squared();
        if square == 0.0 {
            return 0.0;
        }
        let direction = to_light / square.sqrt();
        let cos = if normal == DVec3::ZERO { 1.0 } else { normal.dot(direction).max(0.0) };
        match self.flat {
            None => cos,
            Some(DVec3::ZERO) => cos / square,
            Some(flat) => cos * flat.dot(direction).abs() / square,
        }
    }
}
