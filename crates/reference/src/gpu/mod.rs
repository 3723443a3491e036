//! Scanlines on a GPU: the same samples, rows and candidates as `scanlines`, in WGSL.
//!
//! A group of neighbouring receivers walks the tree once and lists what is between: edges and single triangles
//! (walk.wgsl). A glance, a receiver a lane, tells those that see all of the light or nothing (glance.wgsl); for the
//! others 32 lanes, 8 replicates with every fourth row each, look at the light (look.wgsl). All in f32, the receiver's place and heights over its plane in two of them. What f32
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
use std::sync::atomic::Ordering::Relaxed;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use task::Task;
use umbrage_device::{AdapterChoice, AdapterDescription, Device, DeviceError};
use umbrage_scene::AreaLight;

/// The lights' names in the kernels.
const KINDS: [&str; 4] = ["SUN", "RECT", "DISK", "SPHERE"];
/// Points of one upload, at most: their results take 64 MiB.
const MOST_POINTS: usize = 1 << 22;
/// Points that are prepared while the GPU is at those before.
const SLICE: usize = 1 << 19;
/// First words of results (list.wgsl).
const LIT: u32 = 0xffff_ffff;
const HIDDEN: u32 = 0xffff_fffe;
const FOR_CPU: u32 = 0xffff_fffd;
const AGAIN: u32 = 0xffff_fffc;
const TOO_DEEP: u32 = 0xffff_fffb;
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
    planes: Arc<Planes>,
    scene: Scene,
    buffers: Buffers,
    /// Kept for its room.
    receivers: Vec<[u32; 4]>,
    /// With which of `run::BATCHES` a call begins.
    company: usize,
    share: Share,
}

/// Who found the truth at how many points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// Found on the GPU, most of them at a glance.
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
    /// All receivers, whether they see all of the light or nothing.
    pub glance: f64,
    /// The others, at their samples.
    pub look: f64,
}

impl KernelSeconds {
    /// Of all kernels.
    pub fn all(&self) -> f64 {
        self.walk + self.glance + self.look
    }
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
        let planes = Arc::new(Planes::new(tracer));
        let scene = Scene::new(tracer, &planes, &gpu.device)?;
        let buffers = Buffers::new(&gpu.device, run::BATCHES[0]);
        gpu.device.wait()?;
        Ok(Self {
            tracer,
            gpu,
            planes,
            scene,
            buffers,
            receivers: Vec::new(),
            company: 0,
            share: Share::default(),
        })
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
            return self.some(points, (light, task), settings, false);
        }
        let mut all = GroundTruth::sized(points.len(), settings.basis_samples > 0);
        for start in (0..points.len()).step_by(MOST_POINTS) {
            let range = start..(start + MOST_POINTS).min(points.len());
            let found = self.some(&points.range(range.clone()), (light, task), settings, false)?;
            all.put(&range.map(|i| i as u32).collect::<Vec<u32>>(), &found);
        }
        Ok(all)
    }

    /// As many points as fit; `deep` where there may be more layers than a byte counts.
    fn some(
        &mut self,
        points: &Points,
        (light, task): (&AreaLight, Task),
        settings: &TruthSettings,
        deep: bool,
    ) -> Result<GroundTruth, ReferenceError> {
        let (planes, count) = (Arc::clone(&self.planes), points.len());
        let mut prepared = Prepared::new((&self.tracer.surfaces, &planes), points, light);
        let mut call = self.begin(count, (light, task), settings, deep)?;
        let mut receivers = std::mem::take(&mut self.receivers);
        let tracer = self.tracer;
        let here = |group: &[u32]| tracer.equal(&points.pick(group), light, settings);
        let found = Mutex::new(Vec::new());
        rayon::in_place_scope(|scope| {
            for start in (0..count).step_by(SLICE) {
                let (range, before) = (start..(start + SLICE).min(count), prepared.count);
                let (some, groups) = prepared.next(range.clone(), &mut receivers);
                let others = prepared.others(range);
                if !others.is_empty() {
                    let (found, here) = (&found, &here);
                    scope.spawn(move |_| {
                        let truth = here(&others);
                        found.lock().unwrap_or_else(PoisonError::into_inner).push((others, truth));
                    });
                }
                if some > 0 {
                    self.send(&mut call, (&receivers[..some], before), &prepared.groups[groups])?;
                }
            }
            Ok::<(), ReferenceError>(())
        })?;
        self.receivers = receivers;
        let mut truth = GroundTruth::sized(count, settings.basis_samples > 0);
        let number = samples(settings, light);
        truth.samples.par_iter_mut().for_each(|n| *n = number);
        let mut others = 0;
        for (group, found) in found.into_inner().unwrap_or_else(PoisonError::into_inner) {
            truth.put(&group, &found);
            others += group.len();
        }
        let mut marked = Vec::new();
        if prepared.count > 0 {
            self.finish(call, &prepared)?;
            marked = self.gpu.device.read_with(&self.buffers.staging, |bytes| {
                decode(&prepared, bytemuck::cast_slice(bytes), &mut truth)
            })?;
        }
        let of = |again: bool| {
            let those = marked.iter().filter(|(_, marked)| (*marked == Marked::Deep && !deep) == again);
            those.map(|&(index, _)| index).collect::<Vec<u32>>()
        };
        let [cpu, again] = [false, true].map(of);
        let below = count - others - prepared.count as usize;
        self.share.below += below;
        self.share.cpu += others + cpu.len();
        self.share.gpu += count - below - others - marked.len();
        if !cpu.is_empty() {
            truth.put(&cpu, &here(&cpu));
        }
        if !again.is_empty() {
            truth.put(&again, &self.some(&points.pick(&again), (light, task), settings, true)?);
        }
        Ok(truth)
    }
}

/// Fills in what the GPU found; the receivers that are the CPU's.
fn decode(prepared: &Prepared<'_>, results: &[[u32; 4]], truth: &mut GroundTruth) -> Vec<(u32, Marked)> {
    // NaN: the basis' pass was lost.
    let wants_basis = !truth.basis.is_empty();
    let places = &prepared.places;
    let [first, second] = &mut truth.halves;
    let mean = truth.mean.par_iter_mut().zip(first).zip(second).zip(&mut truth.variance);
    let into = mean.zip(&mut truth.facing);
    let marked = into
        .zip(places)
        .enumerate()
        .filter_map(|(i, (((((mean, first), second), variance), facing), place))| {
            let point = match place.load(Relaxed) {
                BELOW => PointTruth::exact(0.0, false),
                OTHER => return None,
                place => match point(place, results) {
                    Ok(point) if !(wants_basis && point.basis.is_nan()) => point,
                    Ok(_) => return Some((i as u32, Marked::Cpu)),
                    Err(marked) => return Some((i as u32, marked)),
                },
            };
            (*mean, [*first, *second], *variance) = (point.mean, point.halves, point.variance);
            *facing = point.facing;
            None
        })
        .collect();
    truth.basis.par_iter_mut().zip(places).for_each(|(basis, place)| {
        let found = match place.load(Relaxed) {
            BELOW => Some(PointTruth::exact(0.0, false)),
            OTHER => None,
            place => point(place, results).ok(),
        };
        *basis = found.map_or(*basis, |point| point.basis);
    });
    marked
}

/// Who has to find what a look did not.
#[derive(Clone, Copy, PartialEq)]
enum Marked {
    Cpu,
    /// A look that counts more layers.
    Deep,
}

/// What a receiver found.
fn point(place: u32, results: &[[u32; 4]]) -> Result<PointTruth, Marked> {
    let facing = place & ACROSS == 0;
    let [first, second, share, variance] = results[(place & !ACROSS) as usize];
    match first {
        LIT => return Ok(PointTruth::exact(1.0, facing)),
        HIDDEN => return Ok(PointTruth::exact(0.0, facing)),
        FOR_CPU | AGAIN | UNWRITTEN => return Err(Marked::Cpu),
        TOO_DEEP => return Err(Marked::Deep),
        _ => {}
    }
    let halves = [first, second].map(|h| f64::from(h & 0xffff) / f64::from(h >> 16).max(1.0));
    Ok(PointTruth {
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
