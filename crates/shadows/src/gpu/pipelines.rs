//! Pipelines, compiled once per distinct pass.

use crate::recording::{Binding, ComputePass, Format, RasterPass, Recording};
use crate::shader;
use std::collections::HashMap;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};

/// Owns every compiled pipeline of a device.
pub(super) struct Pipelines {
    compute: HashMap<u64, Compute>,
    raster: HashMap<u64, Raster>,
    /// Reads texels without filtering them.
    pub(super) nearest: wgpu::Sampler,
}

#[derive(Clone)]
pub(super) struct Compute {
    pub(super) pipeline: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

#[derive(Clone)]
pub(super) struct Raster {
    pub(super) pipeline: wgpu::RenderPipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device) -> Self {
        let nearest =
            device.create_sampler(&wgpu::SamplerDescriptor { label: Some("nearest"), ..Default::default() });
        Self { compute: HashMap::new(), raster: HashMap::new(), nearest }
    }

    /// The pipeline of a compute pass.
    pub(super) fn compute(&mut self, device: &wgpu::Device, pass: &ComputePass) -> Compute {
        let kinds: Vec<u32> = pass.bindings.iter().map(|b| b.number()).collect();
        let bits: Vec<_> = pass.constants.iter().map(|(name, value)| (*name, value.to_bits())).collect();
        let key = hash_of(&(&pass.shader, pass.entry, bits, kinds));
        self.compute.entry(key).or_insert_with(|| compile_compute(device, pass)).clone()
    }

    /// The pipeline of a raster pass.
    pub(super) fn raster(
        &mut self,
        device: &wgpu::Device,
        (pass, recording): (&RasterPass, &Recording),
    ) -> Raster {
        let formats: Vec<_> = pass.targets.iter().map(|t| recording.info(t.0).format).collect();
        let key = hash_of(&(&pass.shader, formats.clone()));
        self.raster.entry(key).or_insert_with(|| compile_raster(device, pass, &formats)).clone()
    }
}

fn hash_of(value: &impl Hash) -> u64 {
    let mut hasher = DefaultHasher::new();
    value.hash(&mut hasher);
    hasher.finish()
}

fn module(device: &wgpu::Device, (label, source): (&str, &str)) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}

fn group_layout(device: &wgpu::Device, entries: &[wgpu::BindGroupLayoutEntry]) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries })
}

fn compile_compute(device: &wgpu::Device, pass: &ComputePass) -> Compute {
    let source = shader::concatenate(&pass.shader);
    let entries: Vec<_> =
        pass.bindings.iter().map(|&b| layout_entry(b, wgpu::ShaderStages::COMPUTE)).collect();
    let layout = group_layout(device, &entries);
    let constants = shader::declared(&source, &pass.constants);
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(pass.label),
        layout: Some(&device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(pass.label),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        })),
        module: &module(device, (pass.label, &source)),
        entry_point: Some(pass.entry),
        compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
        cache: None,
    });
    Compute { pipeline, layout }
}

fn compile_raster(device: &wgpu::Device, pass: &RasterPass, formats: &[Format]) -> Raster {
    let source = shader::concatenate(&pass.shader);
    let module = module(device, (pass.label, &source));
    let layout = group_layout(device, &[layout_entry(Binding::Globals, wgpu::ShaderStages::VERTEX_FRAGMENT)]);
    let targets: Vec<_> = formats.iter().map(|&f| Some(wgpu_format(f).into())).collect();
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(pass.label),
        layout: Some(&device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(pass.label),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        })),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: size_of::<crate::layout::Vertex>() as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3],
            })],
        },
        // Both sides of every triangle are seen and cast.
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    });
    Raster { pipeline, layout }
}

fn wgpu_format(format: Format) -> wgpu::TextureFormat {
    match format {
        Format::R32Float => wgpu::TextureFormat::R32Float,
        Format::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
        Format::Depth32Float => wgpu::TextureFormat::Depth32Float,
    }
}

fn layout_entry(binding: Binding, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let ty = match binding {
        Binding::Globals => buffer(wgpu::BufferBindingType::Uniform),
        Binding::Anchors => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
        Binding::Values => buffer(wgpu::BufferBindingType::Storage { read_only: false }),
        Binding::ShadowMap(_) | Binding::CameraDepth(_) | Binding::CameraNormal(_) | Binding::Source(_) => {
            wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            }
        }
        Binding::Destination(_) => wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: wgpu::TextureFormat::R32Float,
            view_dimension: wgpu::TextureViewDimension::D2,
        },
        Binding::Nearest => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering),
    };
    wgpu::BindGroupLayoutEntry { binding: binding.number(), visibility, ty, count: None }
}
