//! Synthetic windows: every pixel of a small picture is an anchor of known truth.
#![allow(dead_code, reason = "each test file uses a part of it")]

use glam::{Mat4, Vec3};
use umbrage_frame::{Anchors, View};
use umbrage_metrics::{Panel, PanelTruth, Tiling};

/// A random stream of the tests' own (SplitMix64), so that they do not depend on the crate's.
#[derive(Clone, Copy)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in 0..1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Mean 0, variance 1.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }

    /// A number that depends on nothing but its arguments, uniform in 0..1.
    pub(crate) fn hash(keys: &[u64]) -> f64 {
        let mut random =
            Self(keys.iter().fold(1, |h, k| Self(h ^ k.wrapping_mul(0x2545_f491_4f6c_dd1d)).bits()));
        random.unit()
    }
}

/// A picture whose pixels all see the plane z = 0, one metre a pixel.
#[derive(Clone, Copy)]
pub(crate) struct Picture {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl Picture {
    pub(crate) fn points(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Column and row of a point.
    pub(crate) fn place(&self, point: usize) -> (f64, f64) {
        ((point % self.width as usize) as f64, (point / self.width as usize) as f64)
    }

    pub(crate) fn anchors(&self) -> Anchors {
        let view = View {
            width: self.width,
            height: self.height,
            clip_from_world: Mat4::IDENTITY,
            camera_from_world: Mat4::IDENTITY,
            yfov_radians: 1.0,
        };
        let at = |p: usize| Vec3::new(self.place(p).0 as f32, -self.place(p).1 as f32, 0.0);
        Anchors {
            view,
            pixel: (0..self.points() as u32).collect(),
            position: (0..self.points()).map(at).collect(),
            normal: vec![Vec3::Z; self.points()],
        }
    }

    /// Truth `g(x, y)` with independent normal noise of this standard deviation in each half and in
    /// the basis.
    pub(crate) fn truth(&self, g: impl Fn(f64, f64) -> f64, deviation: f64, seed: u64) -> PanelTruth {
        let mut random = Random(seed);
        let mut estimate = || -> Vec<f32> {
            let noisy = |p: usize| {
                let (x, y) = self.place(p);
                let noise = if deviation > 0.0 { deviation * random.normal() } else { 0.0 };
                (g(x, y) + noise) as f32
            };
            (0..self.points()).map(noisy).collect()
        };
        let halves = [estimate(), estimate()];
        let variance = vec![(0.5 * deviation * deviation) as f32; self.points()];
        PanelTruth { frames: 1, halves, basis: estimate(), variance }
    }

    /// `v(frame, seed, x, y)`.
    pub(crate) fn panel(
        &self,
        frames: usize,
        seeds: usize,
        mut v: impl FnMut(usize, usize, f64, f64) -> f64,
    ) -> Panel {
        let mut values = Vec::with_capacity(frames * seeds * self.points());
        for frame in 0..frames {
            for seed in 0..seeds {
                values.extend((0..self.points()).map(|p| {
                    let (x, y) = self.place(p);
                    v(frame, seed, x, y) as f32
                }));
            }
        }
        Panel { points: self.points(), frames, seeds, values }
    }

    pub(crate) fn tiling(&self, truth: &PanelTruth) -> Tiling {
        self.tiling_of(truth, 32)
    }

    pub(crate) fn tiling_of(&self, truth: &PanelTruth, tile_px: u32) -> Tiling {
        Tiling::new(&self.anchors(), truth, &vec![true; self.points()], tile_px).expect("a valid tiling")
    }
}

/// A ramp from 0 to 1 along x.
pub(crate) fn ramp(picture: Picture) -> impl Fn(f64, f64) -> f64 {
    move |x, _| (x + 0.5) / f64::from(picture.width)
}

/// Shadows of slats: penumbrae of `width` pixels every `period` pixels, slightly turned.
pub(crate) fn slats(width: f64, period: f64) -> impl Fn(f64, f64) -> f64 {
    move |x, y| {
        let phase = (x + 0.2 * y).rem_euclid(2.0 * period) - period;
        let ramp = ((phase.abs() - 0.5 * period) / width + 0.5).clamp(0.0, 1.0);
        ramp * ramp * (3.0 - 2.0 * ramp)
    }
}
