//! Scanlines on a GPU: the same samples, rows and candidates as `scanlines`, in WGSL.
//!
//! A group of neighbouring receivers walks the tree once (walk.wgsl) and lists its candidates; then 32
//! lanes, 8 replicates with every fourth row each, look at the light from one receiver after another
//! (look.wgsl). All in f32: the receiver's place and heights over its plane in two floats. What f32
//! cannot tell is marked and found on the CPU, as is what does not fit; [`Share`] counts.
//!
//! The only place of this crate that knows wgpu.

mod kernels;
mod prepare;
mod task;

use crate::truth::PointTruth;
use crate::refine::refined;
use crate::scanlines::Rulings;
use crate::{GroundTruth, Method, Points, ReferenceError, Tracer, TruthSettings};
use glam::DVec3;
use kernels::{Kernels, LookFor};
use prepare::{ACROSS, BELOW, IN_AIR, OTHER, Prepared};
use rayon::prelude::*;
use task::{Task, kind};
use umbrage_device::{AdapterDescription, Device, DeviceError};
use umbrage_scene::AreaLight;
use wgpu::BufferUsages as Usage;

/// The lights' names in the kernels.
const KINDS: [&str; 4] = ["SUN", "RECT", "DISK", "SPHERE"];
/// Points of one upload, at most: their results take 64 MiB.
const MOST_POINTS: usize = 1 << 22;
/// Words of the pool of candidates: what a binding holds on every adapter.
const POOL_WORDS: u32 = 1 << 25;
/// Groups that share the pool: 2048 candidates each; those that found no room share it again in
/// smaller companies.
const BATCHES: [usize; 4] = [16_384, 1024, 64, 4];
/// Passes that are timed.
const MOST_TIMED: u32 = 256;
/// Parts of a group of 64, each a workgroup's (`RECEIVERS` in look.wgsl).
const PARTS: u32 = 4;
/// First words of results (look.wgsl).
const LIT: u32 = 0xffff_ffff;
const HIDDEN: u32 = 0xffff_fffe;
const FOR_CPU: u32 = 0xffff_fffd;
const AGAIN: u32 = 0xffff_fffc;

/// Who found the truth at how many points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// Looked at on the GPU.
    pub gpu: usize,
    /// Whose horizon told: the light is below it.
    pub below: usize,
    /// Marked, and found on the CPU.
    pub cpu: usize,
    /// Seconds of GPU time in kernels, where the adapter has timestamps. On a software adapter they
    /// are no cost.
    pub kernel_seconds: Option<f64>,
}

/// A scene made ready for truth on a GPU.
pub struct GpuTracer<'a> {
    tracer: &'a Tracer,
    device: &'a Device,
    planes: Planes,
    scene: Scene,
    kernels: Kernels,
    buffers: Buffers,
    share: Share,
}

/// Every triangle's plane in f64.
pub(crate) struct Planes(Vec<Option<(DVec3, f64)>>);

/// What is uploaded once.
struct Scene {
    nodes: wgpu::Buffer,
    corners: wgpu::Buffer,
    planes: wgpu::Buffer,
    /// The pair of nodes to begin with.
    root: u32,
}

/// What is kept from call to call, as large as was needed so far.
struct Buffers {
    receivers: wgpu::Buffer,
    order: wgpu::Buffer,
    groups: wgpu::Buffer,
    results: wgpu::Buffer,
    staging: wgpu::Buffer,
    pool: wgpu::Buffer,
    heads: wgpu::Buffer,
    next_free: wgpu::Buffer,
}

impl Planes {
    fn new(tracer: &Tracer) -> Self {
        let surfaces = &tracer.surfaces;
        let of = |slot: usize| {
            let [a, b, c] = surfaces.corners_f64(slot as u32);
            let normal = (b - a).cross(c - a).try_normalize()?;
            Some((normal, normal.dot(a)))
        };
        Self((0..surfaces.corners.len()).into_par_iter().map(of).collect())
    }

    /// A unit normal; `None` for a triangle without an area, and beyond the last.
    pub(crate) fn normal(&self, slot: usize) -> Option<DVec3> {
        self.0.get(slot).copied().flatten().map(|p| p.0)
    }
}

impl<'a> GpuTracer<'a> {
    /// Uploads the scene.
    ///
    /// # Errors
    /// A scene that does not fit into the device, or what its driver refuses.
    pub fn new(tracer: &'a Tracer, device: &'a Device) -> Result<Self, ReferenceError> {
        if tracer.surfaces.corners.len() >= IN_AIR as usize {
            return Err(ReferenceError::TooManyTriangles(tracer.surfaces.corners.len()));
        }
        let planes = Planes::new(tracer);
        let scene = Scene::new(tracer, &planes, device)?;
        let buffers = Buffers::new(device);
        device.wait()?;
        Ok(Self { tracer, device, planes, scene, kernels: Kernels::default(), buffers, share: Share::default() })
    }

    /// On what.
    pub fn adapter(&self) -> &AdapterDescription {
        self.device.description()
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
        self.share = Share { kernel_seconds: Some(0.0), ..Share::default() };
        match settings.tolerance {
            Some(tolerance) => refined(points, settings, tolerance, |p, s| self.equal(p, light, s)),
            None => self.equal(points, light, settings),
        }
    }

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
        let mut each = Vec::with_capacity(points.len());
        for start in (0..points.len()).step_by(MOST_POINTS) {
            let end = (start + MOST_POINTS).min(points.len());
            match end - start == points.len() {
                true => each = self.some(points, (light, task), settings)?,
                false => each.extend(self.some(&points.range(start..end), (light, task), settings)?),
            }
        }
        Ok(GroundTruth::of(&each, settings, crate::scanlines::samples(settings, light)))
    }

    fn some(
        &mut self,
        points: &Points,
        (light, task): (&AreaLight, Task),
        settings: &TruthSettings,
    ) -> Result<Vec<PointTruth>, ReferenceError> {
        let prepared = Prepared::new((&self.tracer.surfaces, &self.planes), points, light);
        let basis = settings.basis_samples > 0;
        let results = self.look(&prepared, (light, task), settings, points.len())?;
        let decode = |(&word, result): (&u32, &[u32; 4])| decode(word, result, basis);
        let mut each: Vec<Option<PointTruth>> = match &results {
            Some(staging) => self.device.read_with(staging, |bytes| {
                prepared.words.par_iter().zip(bytemuck::cast_slice(bytes)).map(decode).collect()
            })?,
            None => prepared.words.par_iter().map(|word| decode((word, &[FOR_CPU; 4]))).collect(),
        };
        let marked: Vec<u32> = (0..each.len() as u32).filter(|&i| each[i as usize].is_none()).collect();
        let below = prepared.words.par_iter().filter(|&&w| w == BELOW).count();
        self.share.below += below;
        self.share.cpu += marked.len();
        self.share.gpu += points.len() - below - marked.len();
        if !marked.is_empty() {
            let found = self.tracer.equal(&points.pick(&marked), light, settings);
            for (at, &i) in marked.iter().enumerate() {
                each[i as usize] = Some(found.point(at));
            }
        }
        Ok(each.into_par_iter().map(|p| p.unwrap_or(PointTruth::exact(0.0, false))).collect())
    }

    /// Runs the kernels; the staging buffer to read, or nothing where there was nothing to do.
    fn look(
        &mut self,
        prepared: &Prepared,
        (light, mut task): (&AreaLight, Task),
        settings: &TruthSettings,
        points: usize,
    ) -> Result<Option<wgpu::Buffer>, ReferenceError> {
        if prepared.order.is_empty() {
            return Ok(None);
        }
        let rulings = Rulings::new(settings, light);
        let kind = kind(light);
        let looks: Vec<LookFor> = std::iter::once(&rulings.mean)
            .chain(rulings.basis.as_ref())
            .enumerate()
            .map(|(set, ruling)| LookFor::new(kind, set as u32, ruling))
            .collect();
        self.kernels.compile(self.device, &looks);
        let bytes = (points * 16) as u64;
        self.buffers.fit(self.device, prepared, bytes)?;
        let queue = &self.device.queue;
        queue.write_buffer(&self.buffers.receivers, 0, bytemuck::cast_slice(&prepared.receivers));
        queue.write_buffer(&self.buffers.order, 0, bytemuck::cast_slice(&prepared.order));
        task.extent = self.tracer.surfaces.extent;
        task.pool_words = POOL_WORDS;
        task.root = self.scene.root;
        let mut groups = std::borrow::Cow::Borrowed(&prepared.groups[..]);
        for (round, &size) in BATCHES.iter().enumerate() {
            queue.write_buffer(&self.buffers.groups, 0, bytemuck::cast_slice(&groups));
            let timed = self.device.timestamps("truth", MOST_TIMED);
            let mut passes = 0;
            for first in (0..groups.len()).step_by(size) {
                task.first_group = first as u32;
                let count = size.min(groups.len() - first) as u32;
                passes = self.batch(&task, (kind, &looks), count, (timed.as_ref(), passes))?;
            }
            let mut encoder = self.device.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(&self.buffers.results, 0, &self.buffers.staging, 0, bytes);
            let times = timed
                .as_ref()
                .filter(|_| 2 * passes <= MOST_TIMED)
                .map(|queries| self.device.resolve(&mut encoder, queries, 2 * passes));
            queue.submit([encoder.finish()]);
            self.time(times)?;
            if round + 1 == BATCHES.len() {
                break;
            }
            let left = self.left(prepared, &groups)?;
            if left.is_empty() {
                break;
            }
            groups = std::borrow::Cow::Owned(left);
        }
        Ok(Some(self.buffers.staging.clone()))
    }

    /// Adds up what the passes took.
    fn time(&mut self, times: Option<wgpu::Buffer>) -> Result<(), ReferenceError> {
        let ticks = times.map(|staging| self.device.read::<u64>(&staging)).transpose()?;
        let period = f64::from(self.device.queue.get_timestamp_period()) * 1e-9;
        let sum = |t: Vec<u64>| t.chunks_exact(2).map(|t| t[1].saturating_sub(t[0]) as f64 * period).sum::<f64>();
        self.share.kernel_seconds = match (self.share.kernel_seconds, ticks.map(sum)) {
            (Some(before), Some(now)) => Some(before + now),
            _ => None,
        };
        Ok(())
    }

    /// One submission: the walk of some groups, then a look for each set of samples. The passes
    /// so far.
    fn batch(
        &self,
        task: &Task,
        (kind, looks): (u32, &[LookFor]),
        count: u32,
        (queries, mut passes): (Option<&wgpu::QuerySet>, u32),
    ) -> Result<u32, ReferenceError> {
        let gpu = &self.device.device;
        let task = self.device.upload("task", bytemuck::bytes_of(task), Usage::UNIFORM)?;
        let Buffers { receivers, order, groups, results, pool, heads, next_free, .. } = &self.buffers;
        let Scene { nodes, corners, planes, .. } = &self.scene;
        let mut encoder = gpu.create_command_encoder(&Default::default());
        encoder.clear_buffer(next_free, 0, None);
        let mut run = |kernel: &kernels::Kernel, bound: &[&wgpu::Buffer], parts: u32| {
            let entries: Vec<wgpu::BindGroupEntry<'_>> = std::iter::once(&task)
                .chain(bound.iter().copied())
                .enumerate()
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding: binding as u32,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let bind_group = gpu.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &kernel.layout,
                entries: &entries,
            });
            let timestamps = queries.filter(|_| 2 * passes + 2 <= MOST_TIMED).map(|query_set| {
                wgpu::ComputePassTimestampWrites {
                    query_set,
                    beginning_of_pass_write_index: Some(2 * passes),
                    end_of_pass_write_index: Some(2 * passes + 1),
                }
            });
            passes += 1;
            let descriptor = wgpu::ComputePassDescriptor { label: None, timestamp_writes: timestamps };
            let mut pass = encoder.begin_compute_pass(&descriptor);
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(0, &bind_group, &[]);
            pass.dispatch_workgroups(count, parts, 1);
        };
        run(self.kernels.walk(kind), &[corners, receivers, groups, nodes, pool, heads, next_free], 1);
        for look in looks {
            let bound = [corners, receivers, groups, planes, pool, heads, results, order];
            run(self.kernels.look(look), &bound, PARTS);
        }
        self.device.queue.submit([encoder.finish()]);
        self.device.check()?;
        Ok(passes)
    }

    /// The groups that found no room in the pool.
    fn left(&self, prepared: &Prepared, groups: &[prepare::Group]) -> Result<Vec<prepare::Group>, ReferenceError> {
        Ok(self.device.read_with(&self.buffers.staging, |bytes| {
            let results: &[[u32; 4]] = bytemuck::cast_slice(bytes);
            let again = |g: &&prepare::Group| results[prepared.order[g.first as usize] as usize][0] == AGAIN;
            groups.par_iter().filter(again).copied().collect()
        })?)
    }
}

/// One point; `None` where it is the CPU's.
fn decode(word: u32, result: &[u32; 4], basis: bool) -> Option<PointTruth> {
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
        FOR_CPU | AGAIN => return None,
        _ => {}
    }
    let halves = [first, second].map(|h| f64::from(h & 0xffff) / f64::from(h >> 16).max(1.0));
    Some(PointTruth {
        halves: halves.map(|h| h as f32),
        basis: if basis { f32::from_bits(share) } else { 0.0 },
        mean: (0.5 * (halves[0] + halves[1])) as f32,
        variance: f32::from_bits(variance),
        facing,
    })
}

impl Scene {
    fn new(tracer: &Tracer, planes: &Planes, device: &Device) -> Result<Self, ReferenceError> {
        let surfaces = &tracer.surfaces;
        let node = |node: &obvhs::bvh2::node::Bvh2Node| {
            let bounds = node.aabb();
            let [min, max] = [bounds.min, bounds.max].map(|v| v.to_array().map(f32::to_bits));
            [min[0], min[1], min[2], node.prim_count, max[0], max[1], max[2], node.first_index]
        };
        let mut nodes: Vec<[u32; 8]> = surfaces.bvh.nodes.iter().map(node).collect();
        // Nodes are taken in pairs: the root gets a sister that nothing touches.
        let root = nodes.len() as u32;
        let [far, near] = [3.4e38f32, -3.4e38].map(f32::to_bits);
        nodes.extend([nodes[0], [far, far, far, 1, near, near, near, 0]]);
        let corners: Vec<[f32; 4]> =
            surfaces.corners.iter().flatten().map(|c| c.extend(0.0).to_array()).collect();
        let plane = |plane: &Option<(DVec3, f64)>| {
            let (normal, offset) = plane.unwrap_or_default();
            let whole = normal.extend(offset);
            let high = whole.as_vec4();
            [high.to_array(), (whole - high.as_dvec4()).as_vec4().to_array()]
        };
        let planes: Vec<[f32; 4]> = planes.0.iter().flat_map(plane).collect();
        Ok(Self {
            nodes: device.upload("nodes", bytemuck::cast_slice(&nodes), Usage::STORAGE)?,
            corners: device.upload("corners", bytemuck::cast_slice(&corners), Usage::STORAGE)?,
            planes: device.upload("planes", bytemuck::cast_slice(&planes), Usage::STORAGE)?,
            root,
        })
    }
}

impl Buffers {
    fn new(device: &Device) -> Self {
        let none = || buffer(device, "points", 64, Usage::STORAGE | Usage::COPY_DST);
        Self {
            receivers: none(),
            order: none(),
            groups: none(),
            results: buffer(device, "results", 64, Usage::STORAGE | Usage::COPY_SRC),
            staging: device.staging(64),
            pool: buffer(device, "candidates", u64::from(POOL_WORDS) * 4, Usage::STORAGE),
            heads: buffer(device, "lists", BATCHES[0] as u64 * 4, Usage::STORAGE),
            next_free: buffer(device, "next free", 4, Usage::STORAGE | Usage::COPY_DST),
        }
    }

    fn fit(&mut self, device: &Device, prepared: &Prepared, results: u64) -> Result<(), DeviceError> {
        let grow = |into: &mut wgpu::Buffer, bytes: usize| -> Result<(), DeviceError> {
            let bytes = bytes as u64;
            if into.size() < bytes {
                device.fits(bytes, Usage::STORAGE)?;
                *into = buffer(device, "points", bytes, Usage::STORAGE | Usage::COPY_DST);
            }
            Ok(())
        };
        grow(&mut self.receivers, size_of_val(&prepared.receivers[..]))?;
        grow(&mut self.order, size_of_val(&prepared.order[..]))?;
        grow(&mut self.groups, size_of_val(&prepared.groups[..]))?;
        if self.results.size() < results {
            device.fits(results, Usage::STORAGE)?;
            self.results = buffer(device, "results", results, Usage::STORAGE | Usage::COPY_SRC);
        }
        // It is read as a whole.
        if self.staging.size() != results {
            self.staging = device.staging(results);
        }
        Ok(())
    }
}

fn buffer(device: &Device, label: &str, size: u64, usage: Usage) -> wgpu::Buffer {
    device.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage,
        mapped_at_creation: false,
    })
}
