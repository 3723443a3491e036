//! Dispatches: groups in batches that share the pool of candidates.

use super::buffers::Buffers;
use super::kernels::{Kernel, LookFor};
use super::prepare::{Group, Prepared};
use super::scene::Scene;
use super::task::{Task, kind};
use super::{AGAIN, GpuTracer};
use crate::scanlines::Rulings;
use crate::{ReferenceError, TruthSettings};
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;
use umbrage_scene::AreaLight;
use wgpu::BufferUsages as Usage;

/// Groups that share the pool; those that found no room share it again in smaller companies.
pub(super) const BATCHES: [usize; 6] = [16_384, 4096, 1024, 256, 16, 1];
/// Where more than this part of the groups found no room, the next call begins with smaller companies.
const CROWDED: usize = 8;
/// Timestamps of a round, two a pass.
const MOST_TIMES: u32 = 512;
/// Parts of a group of 64, each a workgroup's (`RECEIVERS` in look.wgsl).
const PARTS: u32 = 4;

/// The kernels of a call.
struct Compiled {
    walk: Arc<Kernel>,
    /// The mean's, then the basis'.
    looks: Vec<Arc<Kernel>>,
}

/// Passes of a round so far: whether each was a walk.
type Passes = Vec<bool>;

impl GpuTracer<'_> {
    /// Runs the kernels and leaves the results in the staging buffer.
    pub(super) fn look(
        &mut self,
        prepared: &Prepared,
        (light, mut task): (&AreaLight, Task),
        settings: &TruthSettings,
    ) -> Result<(), ReferenceError> {
        let compiled = self.compile(light, settings)?;
        let device = &self.gpu.device;
        self.buffers.fit(device, prepared)?;
        let queue = &device.queue;
        queue.write_buffer(&self.buffers.receivers, 0, bytemuck::cast_slice(&prepared.receivers));
        queue.write_buffer(&self.buffers.order, 0, bytemuck::cast_slice(&prepared.order));
        let mut encoder = device.device.create_command_encoder(&Default::default());
        // What stays 0 was not written.
        encoder.clear_buffer(&self.buffers.results, 0, None);
        queue.submit([encoder.finish()]);
        task.extent = self.tracer.surfaces.extent;
        task.pool_words = (self.buffers.pool.size() / 4) as u32;
        task.root = self.scene.root;
        let mut groups = Cow::Borrowed(&prepared.groups[..]);
        let mut company = self.company;
        for (round, &size) in BATCHES[self.company..].iter().enumerate() {
            queue.write_buffer(&self.buffers.groups, 0, bytemuck::cast_slice(&groups));
            let times = device.timestamps("truth", MOST_TIMES);
            let mut passes = Passes::new();
            for first in (0..groups.len()).step_by(size) {
                task.first_group = first as u32;
                let count = size.min(groups.len() - first) as u32;
                self.batch(&task, &compiled, count, (times.as_ref(), &mut passes))?;
            }
            let mut encoder = device.device.create_command_encoder(&Default::default());
            let bytes = 16 * prepared.words.len() as u64;
            encoder.copy_buffer_to_buffer(&self.buffers.results, 0, &self.buffers.staging, 0, bytes);
            let count = 2 * passes.len() as u32;
            let times = times.as_ref().filter(|_| count <= MOST_TIMES);
            let times = times.map(|queries| device.resolve(&mut encoder, queries, count));
            queue.submit([encoder.finish()]);
            self.time(times, &passes)?;
            let left = self.left(prepared, &groups)?;
            if left.is_empty() {
                break;
            }
            if round == 0 && left.len() > groups.len() / CROWDED {
                company = (self.company + 1).min(BATCHES.len() - 1);
            }
            groups = Cow::Owned(left);
        }
        self.company = company;
        Ok(())
    }

    fn compile(&self, light: &AreaLight, settings: &TruthSettings) -> Result<Compiled, ReferenceError> {
        let rulings = Rulings::new(settings, light);
        let kind = kind(light);
        let mut kernels = self.gpu.kernels();
        let device = &self.gpu.device;
        let sets = std::iter::once(&rulings.mean).chain(rulings.basis.as_ref()).enumerate();
        let looks =
            sets.map(|(set, ruling)| kernels.look(device, LookFor::new(kind, set as u32, ruling))).collect();
        let compiled = Compiled { walk: kernels.walk(device, kind), looks };
        device.check()?;
        Ok(compiled)
    }

    /// Adds up what the passes took.
    fn time(&mut self, times: Option<wgpu::Buffer>, passes: &[bool]) -> Result<(), ReferenceError> {
        let device = &self.gpu.device;
        let ticks = times.map(|staging| device.read::<u64>(&staging)).transpose()?;
        let period = f64::from(device.queue.get_timestamp_period()) * 1e-9;
        let Some((seconds, ticks)) = self.share.kernels.as_mut().zip(ticks) else {
            self.share.kernels = None;
            return Ok(());
        };
        for (ticks, &walk) in ticks.chunks_exact(2).zip(passes) {
            let took = ticks[1].saturating_sub(ticks[0]) as f64 * period;
            *(if walk { &mut seconds.walk } else { &mut seconds.look }) += took;
        }
        Ok(())
    }

    /// One submission: the walk of some groups, then a look for each set of samples.
    fn batch(
        &self,
        task: &Task,
        compiled: &Compiled,
        count: u32,
        (times, passes): (Option<&wgpu::QuerySet>, &mut Passes),
    ) -> Result<(), ReferenceError> {
        let device = &self.gpu.device;
        let gpu = &device.device;
        let task = device.upload("task", bytemuck::bytes_of(task), Usage::UNIFORM)?;
        let Buffers { receivers, order, groups, results, pool, heads, next_free, .. } = &self.buffers;
        let Scene { nodes, corners, planes, .. } = &self.scene;
        let mut encoder = gpu.create_command_encoder(&Default::default());
        encoder.clear_buffer(next_free, 0, None);
        let mut run = |kernel: &Kernel, bound: &[&wgpu::Buffer], parts: Option<u32>| {
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
            let at = 2 * passes.len() as u32;
            let timestamp_writes =
                times.filter(|_| at + 2 <= MOST_TIMES).map(|query_set| wgpu::ComputePassTimestampWrites {
                    query_set,
                    beginning_of_pass_write_index: Some(at),
                    end_of_pass_write_index: Some(at + 1),
                });
            passes.push(parts.is_none());
            let descriptor = wgpu::ComputePassDescriptor { label: None, timestamp_writes };
            let mut pass = encoder.begin_compute_pass(&descriptor);
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(0, &bind_group, &[]);
            pass.dispatch_workgroups(count, parts.unwrap_or(1), 1);
        };
        run(&compiled.walk, &[corners, receivers, groups, nodes, pool, heads, next_free], None);
        for look in &compiled.looks {
            run(look, &[corners, receivers, groups, planes, pool, heads, results, order], Some(PARTS));
        }
        device.queue.submit([encoder.finish()]);
        // The device's patience is for a batch, not for a whole picture on a slow driver.
        Ok(device.wait()?)
    }

    /// The groups that found no room in the pool.
    fn left(&self, prepared: &Prepared, groups: &[Group]) -> Result<Vec<Group>, ReferenceError> {
        Ok(self.gpu.device.read_with(&self.buffers.staging, |bytes| {
            let results: &[[u32; 4]] = bytemuck::cast_slice(bytes);
            let again = |g: &&Group| results[prepared.order[g.first as usize] as usize][0] == AGAIN;
            groups.par_iter().filter(again).copied().collect()
        })?)
    }
}
