//! Pipelines, compiled once per distinct pass.

use crate::layout::{CutVertex, Vertex};
use crate::recording::{Binding, ComputePass, Format, RasterPass, Recording, TextureId};
use crate::shader::{self, Fragment};
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
    pub(super) fn compute(
        &mut self,
        device: &wgpu::Device,
        (pass, recording): (&ComputePass, &Recording),
    ) -> Compute {
        let slots = slots(&pass.bindings, recording);
        let key = hash_of(&(&pass.shader, pass.entry, bits(&pass.constants), &slots));
        self.compute.entry(key).or_insert_with(|| compile_compute(device, (pass, &slots))).clone()
    }

    /// The pipeline of a raster pass, for one kind of triangles.
    pub(super) fn raster(
        &mut self,
        device: &wgpu::Device,
        (pass, drawn, recording): (&RasterPass, Drawn, &Recording),
    ) -> Raster {
        let formats: Vec<_> = pass.targets.iter().map(|t| recording.info(t.0).format).collect();
        let slots = slots(&drawn.bindings(pass), recording);
        let key = hash_of(&(drawn.shader(pass), &formats, bits(&pass.constants), &slots));
        let compile = || compile_raster(device, (pass, drawn), (&formats, &slots));
        self.raster.entry(key).or_insert_with(compile).clone()
    }
}

/// Which triangles a pipeline draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Drawn {
    /// Those that are there everywhere.
    Whole,
    /// Those with a mask.
    CutOut,
}

impl Drawn {
    fn shader(self, pass: &RasterPass) -> &[Fragment] {
        match self {
            Self::Whole => &pass.shader,
            Self::CutOut => &pass.cut,
        }
    }

    /// What it reads.
    pub(super) fn bindings(self, pass: &RasterPass) -> Vec<Binding> {
        let masks = (self == Self::CutOut).then_some(Binding::Cutouts);
        pass.bindings.iter().copied().chain(masks).collect()
    }

    /// Bytes from vertex to vertex, and what one has.
    fn vertex(self) -> (usize, &'static [wgpu::VertexAttribute]) {
        const WHOLE: [wgpu::VertexAttribute; 2] = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
        const CUT_OUT: [wgpu::VertexAttribute; 4] =
            wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x2, 3 => Uint32];
        match self {
            Self::Whole => (size_of::<Vertex>(), &WHOLE),
            Self::CutOut => (size_of::<CutVertex>(), &CUT_OUT),
        }
    }
}

/// A binding and the format of its texture: what a layout depends on.
type Slot = (Binding, Option<Format>);

fn slots(bindings: &[Binding], recording: &Recording) -> Vec<Slot> {
    let format = |b: &Binding| b.texture().map(|(t, _)| recording.info(t).format);
    // Which texture it is, and which level, makes no difference.
    let kind = |b: &Binding| match *b {
        Binding::SourceLevel(..) => Binding::Source(TextureId(0)),
        Binding::DestinationLevel(..) => Binding::Destination(TextureId(0)),
        Binding::ShadowMap(_) => Binding::ShadowMap(TextureId(0)),
        Binding::CameraDepth(_) => Binding::CameraDepth(TextureId(0)),
        Binding::CameraNormal(_) => Binding::CameraNormal(TextureId(0)),
        Binding::Source(_) => Binding::Source(TextureId(0)),
        Binding::SourceB(_) => Binding::SourceB(TextureId(0)),
        Binding::SourceC(_) => Binding::SourceC(TextureId(0)),
        Binding::Destination(_) => Binding::Destination(TextureId(0)),
        Binding::EarlierGlobals(_) => Binding::Globals,
        Binding::Past(_) => Binding::Past(0),
        other @ (Binding::Globals
        | Binding::Anchors
        | Binding::Values
        | Binding::Nearest
        | Binding::Cutouts) => other,
    };
    bindings.iter().map(|b| (kind(b), format(b))).collect()
}

fn bits(constants: &[(&'static str, f64)]) -> Vec<(&'static str, u64)> {
    constants.iter().map(|(name, value)| (*name, value.to_bits())).collect()
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

fn compile_compute(device: &wgpu::Device, (pass, slots): (&ComputePass, &[Slot])) -> Compute {
    let source = shader::concatenate(&pass.shader);
    let entries: Vec<_> = slots.iter().map(|&s| layout_entry(s, wgpu::ShaderStages::COMPUTE)).collect();
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

fn compile_raster(
    device: &wgpu::Device,
    (pass, drawn): (&RasterPass, Drawn),
    (formats, slots): (&[Format], &[Slot]),
) -> Raster {
    let source = shader::concatenate(drawn.shader(pass));
    let (stride, attributes) = drawn.vertex();
    let module = module(device, (pass.label, &source));
    let stages = wgpu::ShaderStages::VERTEX_FRAGMENT;
    let entries: Vec<_> = slots.iter().map(|&s| layout_entry(s, stages)).collect();
    let layout = group_layout(device, &entries);
    let constants = shader::declared(&source, &pass.constants);
    let options = || wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
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
            compilation_options: options(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: stride as u64,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes,
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
            compilation_options: options(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    });
    Raster { pipeline, layout }
}

pub(super) fn wgpu_format(format: Format) -> wgpu::TextureFormat {
    match format {
        Format::R32Float => wgpu::TextureFormat::R32Float,
        Format::Rg32Float => wgpu::TextureFormat::Rg32Float,
        Format::Rg32Uint => wgpu::TextureFormat::Rg32Uint,
        Format::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
        Format::Depth32Float => wgpu::TextureFormat::Depth32Float,
    }
}

fn layout_entry((binding, format): Slot, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let view_dimension = wgpu::TextureViewDimension::D2;
    let ty = match (binding, format) {
        (Binding::Anchors | Binding::Cutouts, _) => {
            buffer(wgpu::BufferBindingType::Storage { read_only: true })
        }
        (Binding::Values, _) => buffer(wgpu::BufferBindingType::Storage { read_only: false }),
        (Binding::Nearest, _) => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::NonFiltering),
        (_, Some(format)) if binding.is_destination() => wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: wgpu_format(format),
            view_dimension,
        },
        (_, Some(format)) => wgpu::BindingType::Texture {
            sample_type: match format {
                Format::Rg32Uint => wgpu::TextureSampleType::Uint,
                _ => wgpu::TextureSampleType::Float { filterable: false },
            },
            view_dimension,
            multisampled: false,
        },
        (_, None) => buffer(wgpu::BufferBindingType::Uniform),
    };
    wgpu::BindGroupLayoutEntry { binding: binding.number(), visibility, ty, count: None }
}
