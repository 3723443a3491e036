//! Dispatches: groups in batches that share the pool of candidates.

use super::buffers::Buffers;
use super::kernels::{Kernel, LookFor};
use super::prepare::{Group, Prepared, TOGETHER};
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
/// Workgroups that share a queue, at most: as many as a large device holds at once.
const WORKERS: u32 = 32_768;
/// Receivers that each takes at a time (`RECEIVERS` in look.wgsl).
const AT_A_TIME: u32 = 4;

/// The kernels of a call.
struct Compiled {
    walk: Arc<Kernel>,
    glance: Arc<Kernel>,
    /// The mean's, then the basis'.
    looks: Vec<Arc<Kernel>>,
}

/// Passes of a round so far.
type Passes = Vec<Pass>;

#[derive(Clone, Copy)]
enum Pass {
    Walk,
    Glance,
    Look,
}

/// Dispatches for a number of points.
pub(super) struct Call {
    compiled: Compiled,
    task: Task,
    times: Option<wgpu::QuerySet>,
    passes: Passes,
}

impl GpuTracer<'_> {
    /// Makes ready for so many points.
    pub(super) fn begin(
        &mut self,
        points: usize,
        (light, mut task): (&AreaLight, Task),
        settings: &TruthSettings,
        deep: bool,
    ) -> Result<Call, ReferenceError> {
        let compiled = self.compile(light, settings, deep)?;
        let device = &self.gpu.device;
        self.buffers.fit(device, points)?;
        let mut encoder = device.device.create_command_encoder(&Default::default());
        // What stays 0 was not written.
        encoder.clear_buffer(&self.buffers.results, 0, None);
        device.queue.submit([encoder.finish()]);
        task.extent = self.tracer.surfaces.extent;
        task.pool_words = (self.buffers.pool.size() / 4) as u32;
        task.root = self.scene.root;
        Ok(Call { compiled, task, times: device.timestamps("truth", MOST_TIMES), passes: Passes::new() })
    }

    /// Sends receivers, of which so many were sent before, and the groups they stand in, and lets the kernels run.
    pub(super) fn send(
        &mut self,
        call: &mut Call,
        (receivers, before): (&[[u32; 4]], u32),
        groups: &[Group],
    ) -> Result<(), ReferenceError> {
        let bytes = bytemuck::cast_slice(receivers);
        self.gpu.device.queue.write_buffer(&self.buffers.receivers, 16 * u64::from(before), bytes);
        self.batches(call, groups, BATCHES[self.company])
    }

    /// Waits for the results and leaves them in the staging buffer, in the order of the receivers.
    pub(super) fn finish(&mut self, mut call: Call, prepared: &Prepared<'_>) -> Result<(), ReferenceError> {
        let mut groups = Cow::Borrowed(&prepared.groups[..]);
        let (first, mut next) = (self.company, self.company);
        for company in first.. {
            let device = &self.gpu.device;
            let mut encoder = device.device.create_command_encoder(&Default::default());
            let bytes = 16 * u64::from(prepared.count);
            encoder.copy_buffer_to_buffer(&self.buffers.results, 0, &self.buffers.staging, 0, bytes);
            let count = 2 * call.passes.len() as u32;
            let times = call.times.as_ref().filter(|_| count <= MOST_TIMES);
            let times = times.map(|queries| device.resolve(&mut encoder, queries, count));
            device.queue.submit([encoder.finish()]);
            let left = self.left(&groups)?;
            self.time(times, &call.passes)?;
            let Some(&smaller) = BATCHES.get(company + 1).filter(|_| !left.is_empty()) else { break };
            if company == first && left.len() > groups.len() / CROWDED {
                next = first + 1;
            }
            groups = Cow::Owned(left);
            call.times = self.gpu.device.timestamps("truth", MOST_TIMES);
            call.passes.clear();
            self.batches(&mut call, &groups, smaller)?;
        }
        self.company = next;
        Ok(())
    }

    fn batches(&mut self, call: &mut Call, groups: &[Group], size: usize) -> Result<(), ReferenceError> {
        let device = &self.gpu.device;
        self.buffers.fit_groups(device, size_of_val(groups))?;
        device.queue.write_buffer(&self.buffers.groups, 0, bytemuck::cast_slice(groups));
        for first in (0..groups.len()).step_by(size) {
            // The device's patience is for a batch, not for a whole picture on a slow driver.
            device.wait()?;
            call.task.first_group = first as u32;
            let count = size.min(groups.len() - first) as u32;
            let Call { compiled, task, times, passes } = call;
            self.batch(task, compiled, count, (times.as_ref(), passes))?;
        }
        Ok(())
    }

    fn compile(
        &self,
        light: &AreaLight,
        settings: &TruthSettings,
        deep: bool,
    ) -> Result<Compiled, ReferenceError> {
        let rulings = Rulings::new(settings, light);
        let kind = kind(light);
        let mut kernels = self.gpu.kernels();
        let device = &self.gpu.device;
        let sets = std::iter::once(&rulings.mean).chain(rulings.basis.as_ref()).enumerate();
        let looks = sets
            .map(|(set, ruling)| kernels.look(device, LookFor::new((kind, set as u32), ruling, deep)))
            .collect();
        let compiled =
            Compiled { walk: kernels.walk(device, kind), glance: kernels.glance(device, kind), looks };
        device.check()?;
        Ok(compiled)
    }

    /// Adds up what the passes took.
    fn time(&mut self, times: Option<wgpu::Buffer>, passes: &[Pass]) -> Result<(), ReferenceError> {
        let device = &self.gpu.device;
        let ticks = times.map(|staging| device.read::<u64>(&staging)).transpose()?;
        let period = f64::from(device.queue.get_timestamp_period()) * 1e-9;
        let Some((seconds, ticks)) = self.share.kernels.as_mut().zip(ticks) else {
            self.share.kernels = None;
            return Ok(());
        };
        for (ticks, pass) in ticks.chunks_exact(2).zip(passes) {
            let took = ticks[1].saturating_sub(ticks[0]) as f64 * period;
            *match pass {
                Pass::Walk => &mut seconds.walk,
                Pass::Glance => &mut seconds.glance,
                Pass::Look => &mut seconds.look,
            } += took;
        }
        Ok(())
    }

    /// One submission: the walk of some groups, a glance, then a look for each set of samples.
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
        let Buffers { receivers, groups, results, pool, heads, next_free, queue, .. } = &self.buffers;
        let Scene { nodes, corners, planes, .. } = &self.scene;
        let mut encoder = gpu.create_command_encoder(&Default::default());
        encoder.clear_buffer(next_free, 0, None);
        encoder.clear_buffer(queue, 0, Some(8));
        let mut run = |kernel: &Kernel, bound: &[&wgpu::Buffer], (workgroups, which): (u32, Pass)| {
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
            passes.push(which);
            let descriptor = wgpu::ComputePassDescriptor { label: None, timestamp_writes };
            let mut pass = encoder.begin_compute_pass(&descriptor);
            pass.set_pipeline(&kernel.pipeline);
            pass.set_bind_group(0, &bind_group, &[]);
            pass.dispatch_workgroups(workgroups, 1, 1);
        };
        let walk = [corners, receivers, groups, nodes, pool, heads, next_free, planes];
        run(&compiled.walk, &walk, (count, Pass::Walk));
        let look = [corners, receivers, groups, planes, pool, heads, results, queue];
        run(&compiled.glance, &look, (count, Pass::Glance));
        let workers = WORKERS.min((count * TOGETHER as u32).div_ceil(AT_A_TIME));
        for kernel in &compiled.looks {
            run(kernel, &look, (workers, Pass::Look));
        }
        device.queue.submit([encoder.finish()]);
        Ok(device.check()?)
    }

    /// The groups that found no room in the pool.
    fn left(&self, groups: &[Group]) -> Result<Vec<Group>, ReferenceError> {
        Ok(self.gpu.device.read_with(&self.buffers.staging, |bytes| {
            let results: &[[u32; 4]] = bytemuck::cast_slice(bytes);
            let again = |g: &&Group| results[g.first as usize][0] == AGAIN;
            groups.par_iter().filter(again).copied().collect()
        })?)
    }
}
