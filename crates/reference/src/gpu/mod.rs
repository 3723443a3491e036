//! Scanlines on a GPU: the same samples, rows and candidates as `scanlines`, in WGSL.
//!
//! A group of neighbouring receivers walks the tree once (walk.wgsl) and lists its candidates; then 32
//! lanes, 8 replicates with every fourth row each, look at the light from one receiver after another
//! (look.wgsl). All in f32, the receiver's place and heights over its plane in two of them. What f32
//! cannot tell is marked and found on the CPU, as is what does not fit; [`Share`] counts.
//!
//! The only place of this crate that knows wgpu.

mod buffers;
mod kernels;
mod prepare;
mod run;
mod scene;
mod task;

use crate::refine::refined;
use crate::scanlines::samples;
use crate::truth::PointTruth;
use crate::{GroundTruth, Method, Points, ReferenceError, Tracer, TruthSettings};
use buffers::Buffers;
use kernels::Kernels;
use prepare::{ACROSS, BELOW, IN_AIR, OTHER, Prepared};
use rayon::prelude::*;
use scene::{Planes, Scene};
use std::sync::{Mutex, MutexGuard, PoisonError};
use task::Task;
use umbrage_device::{AdapterChoice, AdapterDescription, Device, DeviceError};
use umbrage_scene::AreaLight;

/// The lights' names in the kernels.
const KINDS: [&str; 4] = ["SUN", "RECT", "DISK", "SPHERE"];
/// Points of one upload, at most: their results take 64 MiB.
const MOST_POINTS: usize = 1 << 22;
/// First words of results (look.wgsl).
const LIT: u32 = 0xffff_ffff;
const HIDDEN: u32 = 0xffff_fffe;
const FOR_CPU: u32 = 0xffff_fffd;
const AGAIN: u32 = 0xffff_fffc;
/// No replicate has no samples.
const UNWRITTEN: u32 = 0;

/// A device that finds truth, with the kernels that were needed so far.
pub struct TruthGpu {
    device: Device,
    kernels: Mutex<Kernels>,
}

/// A scene made ready for truth on a GPU.
pub struct GpuTracer<'a> {
    tracer: &'a Tracer,
    gpu: &'a TruthGpu,
    planes: Planes,
    scene: Scene,
    buffers: Buffers,
    /// With which of `run::BATCHES` a call begins.
    company: usize,
    share: Share,
}

/// Who found the truth at how many points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// Looked at on the GPU.
    pub gpu: usize,
    /// Hidden without a look: the light is below the horizon.
    pub below: usize,
    /// Found on the CPU.
    pub cpu: usize,
    /// GPU time, where the adapter has timestamps. On a software adapter it is no cost.
    pub kernels: Option<KernelSeconds>,
}

/// Seconds between the first and the last timestamp of passes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KernelSeconds {
    /// Groups through the tree.
    pub walk: f64,
    /// Receivers at the light.
    pub look: f64,
}

impl TruthGpu {
    /// Opens an adapter.
    ///
    /// # Errors
    /// An unknown backend, no adapter that fits, or one that gives no device.
    pub fn open(choice: &AdapterChoice) -> Result<Self, ReferenceError> {
        let device = Device::open(choice)?;
        let AdapterDescription { name, backend, .. } = device.description();
        if backend == "noop" {
            let reason = "it computes nothing".into();
            return Err(DeviceError::NoDevice { adapter: name.clone(), reason }.into());
        }
        Ok(Self { device, kernels: Mutex::default() })
    }

    /// Which adapter this is.
    pub fn description(&self) -> &AdapterDescription {
        self.device.description()
    }

    fn kernels(&self) -> MutexGuard<'_, Kernels> {
        // A map of whole kernels, whoever panicked.
        self.kernels.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<'a> GpuTracer<'a> {
    /// Uploads the scene.
    ///
    /// # Errors
    /// A scene with cut-out surfaces or one that does not fit into the device, or what its driver refuses.
    pub fn new(tracer: &'a Tracer, gpu: &'a TruthGpu) -> Result<Self, ReferenceError> {
        if tracer.surfaces.corners.len() >= IN_AIR as usize {
            return Err(ReferenceError::TooManyTriangles(tracer.surfaces.corners.len()));
        }
        if tracer.has_masks() {
            return Err(ReferenceError::MasksOnGpu);
        }
        let planes = Planes::new(tracer);
        let scene = Scene::new(tracer, &planes, &gpu.device)?;
        let buffers = Buffers::new(&gpu.device, run::BATCHES[0]);
        gpu.device.wait()?;
        Ok(Self { tracer, gpu, planes, scene, buffers, company: 0, share: Share::default() })
    }

    /// The scene.
    pub(crate) fn tracer(&self) -> &'a Tracer {
        self.tracer
    }

    /// On what.
    pub(crate) fn adapter(&self) -> &AdapterDescription {
        self.gpu.description()
    }

    /// Who found the last truth.
    pub fn share(&self) -> Share {
        self.share
    }

    /// The truth at points, as [`Tracer::truth`] finds it with [`Method::Scanlines`], but for samples on
    /// a silhouette. Other methods are the CPU's, and so is a sun without a size.
    ///
    /// # Errors
    /// What the driver refuses or does not finish.
    ///
    /// # Panics
    /// When the lists of `points` differ in length: a programming error, never a user's.
    pub fn truth(
        &mut self,
        points: &Points,
        light: &AreaLight,
        settings: &TruthSettings,
    ) -> Result<GroundTruth, ReferenceError> {
        points.check();
        self.share = Share { kernels: Some(KernelSeconds::default()), ..Share::default() };
        match settings.tolerance {
            Some(tolerance) => {
                let mut pilot = true;
                refined(points, settings, tolerance, |p, s| {
                    let found = self.equal(p, light, s);
                    // Of the pilot nothing is kept but its time.
                    if std::mem::take(&mut pilot) {
                        self.share = Share { kernels: self.share.kernels, ..Share::default() };
                    }
                    found
                })
            }
            None => self.equal(points, light, settings),
        }
    }

    /// The truth with the same number of samples at all points.
    fn equal(
        &mut self,
        points: &Points,
        light: &AreaLight,
        settings: &TruthSettings,
    ) -> Result<GroundTruth, ReferenceError> {
        let task = Task::new(light, settings.seed).filter(|_| settings.method == Method::Scanlines);
        let Some(task) = task else {
            self.share.cpu += points.len();
            return Ok(self.tracer.equal(points, light, settings));
        };
        if points.len() <= MOST_POINTS {
            return self.some(points, (light, task), settings);
        }
        let mut all = GroundTruth::sized(points.len(), settings.basis_samples > 0);
        for start in (0..points.len()).step_by(MOST_POINTS) {
            let range = start..(start + MOST_POINTS).min(points.len());
            let found = self.some(&points.range(range.clone()), (light, task), settings)?;
            all.put(&range.map(|i| i as u32).collect::<Vec<u32>>(), &found);
        }
        Ok(all)
    }

    /// As many points as fit.
    fn some(
        &mut self,
        points: &Points,
        (light, task): (&AreaLight, Task),
        settings: &TruthSettings,
    ) -> Result<GroundTruth, ReferenceError> {
        let prepared = Prepared::new((&self.tracer.surfaces, &self.planes), points, light);
        let count = points.len();
        let mut truth = GroundTruth::sized(count, settings.basis_samples > 0);
        truth.samples.fill(samples(settings, light));
        let marked = if prepared.order.is_empty() {
            decode(&prepared.words, &vec![[FOR_CPU; 4]; count], &mut truth)
        } else {
            self.look(&prepared, (light, task), settings)?;
            self.gpu.device.read_with(&self.buffers.staging, |bytes| {
                decode(&prepared.words, bytemuck::cast_slice(&bytes[..16 * count]), &mut truth)
            })?
        };
        let below = prepared.words.par_iter().filter(|&&w| w == BELOW).count();
        self.share.below += below;
        self.share.cpu += marked.len();
        self.share.gpu += count - below - marked.len();
        if !marked.is_empty() {
            truth.put(&marked, &self.tracer.equal(&points.pick(&marked), light, settings));
        }
        Ok(truth)
    }
}

/// Fills in what the GPU found; the points that are the CPU's.
fn decode(words: &[u32], results: &[[u32; 4]], truth: &mut GroundTruth) -> Vec<u32> {
    // NaN: the basis' pass was lost.
    let wants_basis = !truth.basis.is_empty();
    let [first, second] = &mut truth.halves;
    let mean = truth.mean.par_iter_mut().zip(first).zip(second).zip(&mut truth.variance);
    let into = mean.zip(&mut truth.facing);
    let from = words.par_iter().zip(results);
    let marked = into
        .zip(from)
        .enumerate()
        .filter_map(|(i, (((((mean, first), second), variance), facing), (&word, result)))| {
            let found = point(word, result).filter(|p| !wants_basis || !p.basis.is_nan());
            let Some(point) = found else { return Some(i as u32) };
            (*mean, [*first, *second], *variance) = (point.mean, point.halves, point.variance);
            *facing = point.facing;
            None
        })
        .collect();
    truth.basis.par_iter_mut().zip(words.par_iter().zip(results)).for_each(|(basis, (&word, result))| {
        *basis = point(word, result).map_or(0.0, |p| p.basis);
    });
    marked
}

/// One point; `None` where it is the CPU's.
fn point(word: u32, result: &[u32; 4]) -> Option<PointTruth> {
    match word {
        BELOW => return Some(PointTruth::exact(0.0, false)),
        OTHER => return None,
        _ => {}
    }
    let facing = word & ACROSS == 0;
    let [first, second, share, variance] = *result;
    match first {
        LIT => return Some(PointTruth::exact(1.0, facing)),
        HIDDEN => return Some(PointTruth::exact(0.0, facing)),
        FOR_CPU | AGAIN | UNWRITTEN => return None,
        _ => {}
    }
    let halves = [first, second].map(|h| f64::from(h & 0xffff) / f64::from(h >> 16).max(1.0));
    Some(PointTruth {
        halves: halves.map(|h| h as f32),
        basis: f32::from_bits(share),
        mean: (0.5 * (halves[0] + halves[1])) as f32,
        variance: f32::from_bits(variance),
        facing,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use umbrage_frame::View;
    use umbrage_scene::Scene as SceneOf;

    /// Lists that find no room are made again in smaller companies, and what never fits is the CPU's. A list of
    /// all 25,940 triangles takes 260,000 words.
    #[test]
    fn a_pool_that_is_too_small_loses_nothing() {
        let scene = SceneOf::builtin("colonnade").expect("a standard scene");
        let tracer = Tracer::new(&scene).expect("a scene");
        let frame = &scene.paths[0].frames[0];
        let camera = frame.camera;
        let view = View {
            width: 64,
            height: 36,
            clip_from_world: camera.clip_from_camera(16.0 / 9.0) * camera.camera_from_world(),
            camera_from_world: camera.camera_from_world(),
            yfov_radians: camera.yfov_radians,
        };
        let points = tracer.primary(&view).points();
        let settings = TruthSettings { samples: 128, basis_samples: 128, ..TruthSettings::default() };
        let gpu = TruthGpu::open(&AdapterChoice::default()).expect("a graphics adapter");
        let mut found = GpuTracer::new(&tracer, &gpu).expect("it fits");
        let whole = found.truth(&points, &frame.light, &settings).expect("done");
        assert_eq!(found.share().cpu, 0);
        for (words, all_fit) in [(300_000, true), (600, false)] {
            let usage = wgpu::BufferUsages::STORAGE;
            found.buffers.pool = buffers::buffer(&gpu.device, "candidates", 4 * words, usage);
            let cut = found.truth(&points, &frame.light, &settings).expect("done");
            let differing = whole.mean.iter().zip(&cut.mean).filter(|(a, b)| a != b).count();
            assert!(differing <= points.len() / 100, "{words} words: {differing} differ");
            let share = found.share();
            assert_eq!(share.cpu == 0, all_fit, "{words} words: {share:?}");
        }
    }
}
