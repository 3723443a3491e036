//! Runs a recording: encodes its passes, times them, reads the values back.

use super::pipelines::{Drawn, Raster};
use super::textures::Allocated;
use super::{Gpu, MAX_TIMED_PASSES};
use crate::recording::{Binding, ComputePass, Pass, RasterPass, Recording, TextureId};
use crate::{Globals, Shaded, ShadowError};

/// GPU time of one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Timing {
    /// The pass.
    pub label: &'static str,
    /// Milliseconds between its first and its last timestamp.
    pub ms: f64,
    /// Whether its result is kept: then this is a cost per scene, not per frame.
    pub kept: bool,
    /// Whether it belongs to an earlier frame, whose cost it was.
    pub earlier: bool,
}

/// The resources of one run.
struct Run<'a> {
    recording: &'a Recording,
    allocated: Allocated,
    /// Of this frame, then of those before it.
    globals: Vec<wgpu::Buffer>,
    values: wgpu::Buffer,
}

impl Gpu {
    /// Executes all passes whose results are not there yet, and reads the values.
    pub(crate) fn run(&mut self, recording: &Recording) -> Result<Shaded, ShadowError> {
        self.execute(recording, recording.passes.iter().any(writes_values))
    }

    /// Executes the same passes for their times alone: reading megabytes of values between frames
    /// lets a GPU fall back to its idle clock.
    pub(crate) fn time(&mut self, recording: &Recording) -> Result<Vec<Timing>, ShadowError> {
        Ok(self.execute(recording, false)?.timings)
    }

    fn execute(&mut self, recording: &Recording, reads_values: bool) -> Result<Shaded, ShadowError> {
        let run = self.prepare(recording)?;
        let mut encoder = self
            .device
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        let mut timed = Vec::new();
        for pass in &recording.passes {
            let written = pass.written();
            if !written.is_empty() && written.iter().all(|t| run.allocated.ready[t.0]) {
                continue;
            }
            let kept = !written.is_empty() && written.iter().all(|t| recording.info(*t).kept.is_some());
            let slot = (timed.len() < MAX_TIMED_PASSES as usize).then_some(timed.len() as u32);
            match pass {
                Pass::Raster(raster) => self.encode_raster(&mut encoder, &run, (raster, slot)),
                Pass::Compute(compute) => self.encode_compute(&mut encoder, &run, (compute, slot)),
            }
            timed.extend(slot.map(|_| (pass, kept)));
        }
        let values = reads_values.then(|| (&run.values, u64::from(recording.globals.receivers) * 4));
        let (floats, times) = self.submit_and_read(encoder, values, timed.len() as u32)?;
        self.textures.filled(recording);
        let timing = |((pass, kept), ms): ((&Pass, bool), f64)| Timing {
            label: pass.label(),
            ms,
            kept,
            earlier: pass.is_earlier(),
        };
        Ok(Shaded { values: floats, timings: timed.into_iter().zip(times).map(timing).collect() })
    }

    fn prepare<'a>(&mut self, recording: &'a Recording) -> Result<Run<'a>, ShadowError> {
        let bytes = (u64::from(recording.globals.receivers) * 4).max(4);
        let limits = self.device.device.limits();
        let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if bytes > limit {
            return Err(ShadowError::TooLarge { what: "a result", wanted: bytes, limit });
        }
        use wgpu::util::DeviceExt as _;
        let block = |globals: &Globals| {
            self.device.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("globals"),
                contents: bytemuck::bytes_of(globals),
                usage: wgpu::BufferUsages::UNIFORM,
            })
        };
        let globals = std::iter::once(&recording.globals).chain(&recording.earlier).map(block).collect();
        let values = self.device.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("values"),
            size: bytes,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let allocated = self.textures.allocate(&self.device.device, recording);
        Ok(Run { recording, allocated, globals, values })
    }

    fn encode_compute(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        run: &Run<'_>,
        (pass, slot): (&ComputePass, Option<u32>),
    ) {
        let compiled = self.pipelines.compute(&self.device.device, (pass, run.recording));
        let group = self.bind_group(run, &compiled.layout, &pass.bindings);
        let timestamp_writes =
            self.timestamps.as_ref().zip(slot).map(|(query_set, slot)| wgpu::ComputePassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(2 * slot),
                end_of_pass_write_index: Some(2 * slot + 1),
            });
        let mut encoded = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some(pass.label), timestamp_writes });
        encoded.set_pipeline(&compiled.pipeline);
        encoded.set_bind_group(0, &group, &[]);
        encoded.dispatch_workgroups(pass.groups[0], pass.groups[1], 1);
    }

    fn encode_raster(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        run: &Run<'_>,
        (pass, slot): (&RasterPass, Option<u32>),
    ) {
        let whole = self.pipelines.raster(&self.device.device, (pass, Drawn::Whole, run.recording));
        let group = self.bind_group(run, &whole.layout, &pass.bindings);
        let cut = (!pass.cut.is_empty()).then(|| {
            let compiled = self.pipelines.raster(&self.device.device, (pass, Drawn::CutOut, run.recording));
            let group = self.bind_group(run, &compiled.layout, &Drawn::CutOut.bindings(pass));
            (compiled, group)
        });
        let view = |t: TextureId| view_of(&run.allocated.textures[t.0], Some(0));
        let clears = pass.viewport.is_none_or(|[x, y, ..]| x == 0 && y == 0);
        let depth = view(pass.depth);
        let targets: Vec<_> = pass.targets.iter().map(|&(t, clear)| (view(t), clear)).collect();
        let attachments: Vec<_> = targets
            .iter()
            .map(|(view, clear)| {
                let colour = wgpu::Color { r: *clear, g: *clear, b: *clear, a: *clear };
                let load = if clears { wgpu::LoadOp::Clear(colour) } else { wgpu::LoadOp::Load };
                let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
                Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops })
            })
            .collect();
        let mut encoded = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(pass.label),
            color_attachments: &attachments,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: self.timestamps.as_ref().zip(slot).map(|(query_set, slot)| {
                wgpu::RenderPassTimestampWrites {
                    query_set,
                    beginning_of_pass_write_index: Some(2 * slot),
                    end_of_pass_write_index: Some(2 * slot + 1),
                }
            }),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        if let Some(scene) = &self.scene {
            if let Some([x, y, width, height]) = pass.viewport {
                encoded.set_viewport(x as f32, y as f32, width as f32, height as f32, 0.0, 1.0);
                encoded.set_scissor_rect(x, y, width, height);
            }
            let mut draw = |compiled: &Raster, group, (vertices, count): &(wgpu::Buffer, u32)| {
                encoded.set_pipeline(&compiled.pipeline);
                encoded.set_bind_group(0, group, &[]);
                encoded.set_vertex_buffer(0, vertices.slice(..));
                encoded.draw(0..*count, 0..1);
            };
            draw(&whole, &group, &scene.whole);
            if let Some((compiled, group)) = &cut {
                draw(compiled, group, &scene.cut);
            }
        }
    }

    fn bind_group(
        &self,
        run: &Run<'_>,
        layout: &wgpu::BindGroupLayout,
        bindings: &[Binding],
    ) -> wgpu::BindGroup {
        let view = |b: &Binding| b.texture().map(|(t, level)| view_of(&run.allocated.textures[t.0], level));
        let views: Vec<_> = bindings.iter().map(view).collect();
        let resource = |binding: &Binding| {
            Some(match *binding {
                Binding::Globals => run.globals[0].as_entire_binding(),
                Binding::EarlierGlobals(age) | Binding::Past(age) => {
                    run.globals.get(age)?.as_entire_binding()
                }
                Binding::Values => run.values.as_entire_binding(),
                Binding::Cutouts => self.scene.as_ref()?.masks.as_entire_binding(),
                Binding::Anchors => self.anchors.as_ref()?.0.as_entire_binding(),
                _ => wgpu::BindingResource::Sampler(&self.pipelines.nearest),
            })
        };
        let entries: Vec<_> = bindings
            .iter()
            .zip(&views)
            .filter_map(|(binding, view)| {
                let resource = match view {
                    Some(view) => wgpu::BindingResource::TextureView(view),
                    None => resource(binding)?,
                };
                Some(wgpu::BindGroupEntry { binding: binding.number(), resource })
            })
            .collect();
        self.device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }
}

/// All levels of a texture, or one.
fn view_of(texture: &wgpu::Texture, level: Option<u32>) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        base_mip_level: level.unwrap_or(0),
        mip_level_count: level.map(|_| 1),
        ..Default::default()
    })
}

fn writes_values(pass: &Pass) -> bool {
    matches!(pass, Pass::Compute(compute) if compute.bindings.contains(&Binding::Values))
}
