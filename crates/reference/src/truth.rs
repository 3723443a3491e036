//! The unoccluded fraction of the light, per point, with its uncertainty.

use crate::aim::{Aim, Elevation};
use crate::owen::LONGEST;
use crate::receiver::Receiver;
use crate::refine::refined;
use crate::samples::{LANES, Layout, LightSamples, light_seed, seed};
use crate::{Points, Tracer, rays, scanlines, shafts};
use glam::DVec3;
use rayon::prelude::*;
use std::convert::Infallible;
use umbrage_scene::AreaLight;

/// How the truth is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruthSettings {
    /// Light samples of each half. Rounded up so that each replicate gets the same number, and down
    /// to 65536 a replicate; scanlines have at least 4 a replicate and
    /// at most [`MOST_ON_SCANLINES`] a half.
    pub samples: u32,
    /// Independent scrambles in all, split evenly over the two halves: even, at least 2 (raised if
    /// it is not) and at most 64. The variance is estimated from their spread: 8 to 16 are good.
    /// Scanlines always take 8.
    pub replicates: u32,
    /// Samples of the third independent estimate, which scores build their projection from; at most
    /// 65536. With 0 there is none, and `basis` stays empty.
    pub basis_samples: u32,
    /// Of all scrambles.
    pub seed: u64,
    /// Which samples, and which way to look at them.
    pub method: Method,
    /// Standard error of V that is wanted at each point, above 0. Points that need it get 4, 16, 64, ...
    /// times as many samples, up to what the method holds; an independent pilot of at most 256 samples
    /// says which, and is thrown away, so that nothing is biased. `None`: the same number for all.
    pub tolerance: Option<f32>,
}

/// Samples of each half that scanlines can hold: 16384 in all.
pub const MOST_ON_SCANLINES: u32 = 8192;

/// How the light is sampled and how the samples are looked at. The two ways of each kind of samples
/// give the same answers but for samples on a silhouette.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Owen-scrambled Sobol points, a ray for each: the arbiter.
    Rays,
    /// The same points; gather the triangles between a point and the light, then test all samples at
    /// once.
    Shafts,
    /// Jittered scanlines, 256 to 16384 samples in eight replicates; triangles cover whole runs of a
    /// line at once. The default.
    Scanlines,
    /// The same scanlines, a ray for each sample: their arbiter.
    ScanlineRays,
}

impl Method {
    /// Whether samples stand on scanlines.
    pub fn on_scanlines(self) -> bool {
        matches!(self, Self::Scanlines | Self::ScanlineRays)
    }
}

impl Default for TruthSettings {
    fn default() -> Self {
        Self {
            samples: 512,
            replicates: 8,
            basis_samples: 1024,
            seed: 0,
            method: Method::Scanlines,
            tolerance: None,
        }
    }
}

/// What a perfect shadow mask would say at each point: the unoccluded fraction of the light's area
/// (rectangle, disk) or solid angle (sphere, sun), 0 to 1. The part of the light below the
/// surface's horizon counts as occluded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundTruth {
    /// The mean of the two halves.
    pub mean: Vec<f32>,
    /// Two independent estimates.
    pub halves: [Vec<f32>; 2],
    /// A third independent estimate; empty when none was asked for.
    pub basis: Vec<f32>,
    /// Of `mean`: unbiased, from the spread of the replicates; 0 where all of them agree, which is nearly always but not
    /// always exact.
    pub variance: Vec<f32>,
    /// Samples that `mean` is made of at each point (on a round light's scanlines: on average).
    pub samples: Vec<u32>,
    /// Whether the whole light is above the surface's horizon on the viewer's side, and the point
    /// outside the light.
    pub facing: Vec<bool>,
}

/// One point's share of [`GroundTruth`].
#[derive(Clone, Copy)]
pub(crate) struct PointTruth {
    pub(crate) halves: [f32; 2],
    pub(crate) basis: f32,
    pub(crate) mean: f32,
    pub(crate) variance: f32,
    pub(crate) facing: bool,
}

/// What a thread keeps from point to point.
#[derive(Default)]
pub(crate) struct Scratch {
    pub(crate) samples: LightSamples,
    /// Per sample: not negative once it is hidden.
    pub(crate) cover: Vec<f32>,
    pub(crate) shafts: shafts::Scratch,
}

/// What is known of all samples of a point.
pub(crate) enum Sight {
    /// Every sample is visible.
    Lit,
    /// No sample is visible.
    Hidden,
    /// `Scratch::cover` tells.
    Sampled,
}

impl Tracer {
    /// The truth at points. `light` may differ from the scene's first. A point's values depend on
    /// its place, the light and the settings alone: not on the number of threads, nor on the other points
    /// (on scanlines but for samples within rounding of an edge).
    ///
    /// # Panics
    /// When the lists of `points` differ in length: a programming error, never a user's.
    pub fn truth(&self, points: &Points, light: &AreaLight, settings: &TruthSettings) -> GroundTruth {
        points.check();
        match settings.tolerance {
            Some(tolerance) => {
                let equal = |p: &Points, s: &TruthSettings| Ok::<_, Infallible>(self.equal(p, light, s));
                let Ok(truth) = refined(points, settings, tolerance, equal);
                truth
            }
            None => self.equal(points, light, settings),
        }
    }

    /// The truth with the same number of samples at all points.
    pub(crate) fn equal(&self, points: &Points, light: &AreaLight, settings: &TruthSettings) -> GroundTruth {
        let layout = settings.layout();
        let task = Task::new(self, light, (settings, &layout));
        let lines = settings.method.on_scanlines();
        let each: Vec<PointTruth> = if lines {
            scanlines::truth(&task, points)
        } else {
            (0..points.len())
                .into_par_iter()
                .with_min_len(64)
                .map_init(Scratch::default, |scratch, index| task.point(points, index, scratch))
                .collect()
        };
        let samples = match lines {
            true => scanlines::samples(settings, light),
            false => (layout.replicates * layout.per_replicate) as u32,
        };
        GroundTruth::of(&each, settings, samples)
    }
}

impl GroundTruth {
    /// Of points that all have so many samples.
    pub(crate) fn of(each: &[PointTruth], settings: &TruthSettings, samples: u32) -> Self {
        let list = |pick: fn(&PointTruth) -> f32| each.par_iter().map(pick).collect::<Vec<f32>>();
        Self {
            mean: list(|p| p.mean),
            halves: [list(|p| p.halves[0]), list(|p| p.halves[1])],
            basis: if settings.basis_samples > 0 { list(|p| p.basis) } else { Vec::new() },
            variance: list(|p| p.variance),
            samples: vec![samples; each.len()],
            facing: each.par_iter().map(|p| p.facing).collect(),
        }
    }
}

impl TruthSettings {
    pub(crate) fn layout(&self) -> Layout {
        let replicates = self.replicates.clamp(2, 64).next_multiple_of(2);
        let per_replicate = self.samples.div_ceil(replicates / 2).clamp(1, LONGEST);
        Layout::new(replicates as usize, per_replicate as usize, self.basis_samples.min(LONGEST) as usize)
    }
}

/// What is the same for all points.
pub(crate) struct Task<'a> {
    pub(crate) tracer: &'a Tracer,
    pub(crate) light: &'a AreaLight,
    pub(crate) settings: &'a TruthSettings,
    pub(crate) layout: &'a Layout,
    pub(crate) seed: u64,
}

impl<'a> Task<'a> {
    pub(crate) fn new(
        tracer: &'a Tracer,
        light: &'a AreaLight,
        (settings, layout): (&'a TruthSettings, &'a Layout),
    ) -> Self {
        Self { tracer, light, settings, layout, seed: light_seed(settings.seed, light) }
    }

    pub(crate) fn point(&self, points: &Points, index: usize, scratch: &mut Scratch) -> PointTruth {
        let receiver = Receiver::new(&self.tracer.surfaces, points, index);
        let Some(aim) = Aim::new(self.light, &receiver) else { return PointTruth::exact(1.0, false) };
        let elevation = aim.elevation(receiver.normal);
        let facing = elevation == Elevation::Above;
        let seed = seed(self.seed, points.position[index]);
        match self.sight(&receiver, &aim, seed, scratch) {
            Sight::Lit => PointTruth::exact(1.0, facing),
            Sight::Hidden => PointTruth::exact(0.0, facing),
            Sight::Sampled => PointTruth { facing, ..self.count(&scratch.cover) },
        }
    }

    /// Looks at the light through whatever is between.
    pub(crate) fn sight(&self, receiver: &Receiver, aim: &Aim, seed: u64, scratch: &mut Scratch) -> Sight {
        let elevation = aim.elevation(receiver.normal);
        if elevation == Elevation::Below {
            return Sight::Hidden;
        }
        let surfaces = &self.tracer.surfaces;
        let between = match self.settings.method {
            Method::Rays | Method::ScanlineRays => shafts::Between::TooMany,
            Method::Shafts | Method::Scanlines => {
                shafts::gather(surfaces, receiver, aim, &mut scratch.shafts)
            }
        };
        match between {
            shafts::Between::Nothing if elevation == Elevation::Above => return Sight::Lit,
            shafts::Between::Everything => return Sight::Hidden,
            _ => {}
        }
        self.layout.fill(&mut scratch.samples, aim, seed);
        horizon(aim, receiver.normal, &scratch.samples, &mut scratch.cover);
        scratch.cover[self.layout.len()..].fill(1.0);
        match between {
            shafts::Between::TooMany => {
                rays::cover(surfaces, (receiver, aim), &scratch.samples, &mut scratch.cover);
            }
            _ => {
                let with = (&scratch.shafts, &scratch.samples);
                shafts::cover(surfaces, (receiver, aim), with, &mut scratch.cover);
            }
        }
        Sight::Sampled
    }

    /// Means over the sets of samples, in a fixed order.
    fn count(&self, cover: &[f32]) -> PointTruth {
        let visible = |set: &[f32]| set.iter().filter(|&&c| c < 0.0).count() as f64;
        let k = self.layout.replicates;
        let n = self.layout.per_replicate as f64;
        let (mut sum, mut squares) = ([0.0; 2], 0.0);
        let mut basis = 0.0;
        for (set, range) in self.layout.sets().enumerate() {
            let visible = visible(&cover[range]);
            if set < k {
                sum[usize::from(set >= k / 2)] += visible;
                squares += visible * visible;
            } else {
                basis = visible / self.layout.basis.max(1) as f64;
            }
        }
        let k = k as f64;
        let total = sum[0] + sum[1];
        // Sum of squared deviations of the K counts, whose mean has this variance: exact integers
        // below 2^53 up to here.
        let deviations = (squares - total * total / k).max(0.0);
        PointTruth {
            halves: sum.map(|s| (2.0 * s / (k * n)) as f32),
            basis: basis as f32,
            mean: (total / (k * n)) as f32,
            variance: (deviations / (k * (k - 1.0) * n * n)) as f32,
            facing: true,
        }
    }
}

impl PointTruth {
    pub(crate) const fn exact(value: f32, facing: bool) -> Self {
        Self { halves: [value; 2], basis: value, mean: value, variance: 0.0, facing }
    }
}

/// Starts `cover`: hidden where a sample is below the horizon, otherwise not yet.
fn horizon(aim: &Aim, normal: DVec3, samples: &LightSamples, cover: &mut Vec<f32>) {
    cover.clear();
    cover.resize(samples.x.len().next_multiple_of(LANES), -1.0);
    if aim.elevation(normal) == Elevation::Across {
        let (a, b, c) = (normal.dot(aim.u) as f32, normal.dot(aim.v) as f32, normal.dot(aim.axis) as f32);
        for ((cover, x), y) in cover.iter_mut().zip(&samples.x).zip(&samples.y) {
            *cover = if a * x + b * y + c > 0.0 { -1.0 } else { 1.0 };
        }
    }
}
