//! The beauty picture: direct light and diffuse interreflection. It plays no part in mask scores.

use crate::Tracer;
use crate::aim::Aim;
use crate::irradiance::Emitter;
use crate::owen::{LONGEST, mix};
use crate::primary::CameraRays;
use crate::rays;
use crate::receiver::Receiver;
use crate::samples::{LightSamples, light_seed};
use crate::surfaces::Line;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use sobol_burley::sample_4d;
use std::f64::consts::{PI, TAU};
use umbrage_frame::{Image, View};
use umbrage_scene::AreaLight;

/// How the beauty picture is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RadianceSettings {
    /// Paths through each pixel centre, at most 65536.
    pub samples: u32,
    /// Diffuse reflections after the first surface; 0 for direct light alone.
    pub bounces: u32,
    /// Of all pixels.
    pub seed: u64,
}

impl Tracer {
    /// Radiance through the pixel centres from a light of unit radiance, by paths with next-event
    /// estimation: linear, per colour; black where nothing is hit. The light itself is not seen.
    pub fn radiance(&self, view: &View, light: &AreaLight, settings: &RadianceSettings) -> Image<Vec3> {
        let camera = CameraRays::new(view);
        let paths = Paths { tracer: self, light, settings, seed: light_seed(settings.seed, light) };
        let pixels: Vec<Vec3> = (0..view.height * view.width)
            .into_par_iter()
            .map_init(LightSamples::default, |scratch, index| {
                let line = camera.line(index % view.width, index / view.width);
                paths.pixel(&line, index, scratch)
            })
            .collect();
        Image::from_pixels(view.width, view.height, pixels)
    }
}

/// A surface on a path.
#[derive(Clone, Copy)]
struct Vertex {
    receiver: Receiver,
    albedo: DVec3,
}

struct Paths<'a> {
    tracer: &'a Tracer,
    light: &'a AreaLight,
    settings: &'a RadianceSettings,
    seed: u64,
}

impl Paths<'_> {
    fn pixel(&self, line: &Line, index: u32, scratch: &mut LightSamples) -> Vec3 {
        let Some(first) = self.vertex(line, |_, _| false) else { return Vec3::ZERO };
        let count = self.settings.samples.clamp(1, LONGEST);
        let seed = mix(self.seed ^ u64::from(index));
        let sum: DVec3 = (0..count).map(|path| self.path(first, [seed, u64::from(path)], scratch)).sum();
        (sum / f64::from(count)).as_vec3()
    }

    /// The light that one path brings back.
    fn path(&self, first: Vertex, [seed, path]: [u64; 2], scratch: &mut LightSamples) -> DVec3 {
        let mut vertex = first;
        let mut throughput = DVec3::ONE;
        let mut radiance = DVec3::ZERO;
        for bounce in 0..=self.settings.bounces {
            // Four dimensions a surface, each set scrambled and shuffled on its own.
            let [x, y, p, q] = sample_4d(path as u32, 0, mix(seed ^ (u64::from(bounce) << 32)) as u32);
            throughput *= vertex.albedo;
            radiance += throughput * (self.direct(&vertex.receiver, [x, y], scratch) / PI);
            if bounce == self.settings.bounces {
                break;
            }
            let receiver = vertex.receiver;
            let direction = cosine(receiver.normal, [p, q]);
            let line = Line { origin: receiver.position, direction, range: [0.0, f64::INFINITY] };
            match self.vertex(&line, |slot, corners| receiver.skips(slot, corners)) {
                Some(next) => vertex = next,
                None => break,
            }
        }
        radiance
    }

    fn vertex(&self, line: &Line, skip: impl Fn(u32, &[Vec3; 3]) -> bool) -> Option<Vertex> {
        let hit = self.tracer.surfaces.closest(line, skip)?;
        let normal = self.tracer.normal_towards(&hit, line.direction);
        let position = line.origin + line.direction * hit.distance;
        let albedo = self.tracer.albedo(hit.slot, position);
        Some(Vertex { receiver: Receiver::hit(hit.slot, position, normal), albedo })
    }

    /// Irradiance from the light, by one sample.
    fn direct(&self, receiver: &Receiver, sample: [f32; 2], scratch: &mut LightSamples) -> f64 {
        let Some(aim) = Aim::new(self.light, receiver) else { return 0.0 };
        scratch.set_one(&aim, sample);
        let emitter = Emitter::new(&aim);
        let weight = emitter.size * emitter.weight(receiver.normal, scratch.direction(&aim, 0));
        let hidden = || rays::blocked(&self.tracer.surfaces, (receiver, &aim), scratch, 0);
        if weight == 0.0 || hidden() { 0.0 } else { weight }
    }
}

/// A direction of the hemisphere, its density the cosine over pi (Malley's method).
fn cosine(normal: DVec3, [p, q]: [f32; 2]) -> DVec3 {
    let (radius, angle) = (f64::from(p).sqrt(), TAU * f64::from(q));
    let (u, v) = normal.any_orthonormal_pair();
    let up = (1.0 - radius * radius).max(0.0).sqrt();
    (u * (radius * angle.cos()) + v * (radius * angle.sin()) + normal * up).normalize()
}
