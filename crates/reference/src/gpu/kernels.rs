//! The kernels, compiled for a light and a ruling.

use super::KINDS;
use super::scene::PIECES;
use crate::rays::LIGHT_GAP;
use crate::receiver::COPLANAR;
use crate::scanlines::{BEYOND, MARGIN, Ruling, STEP};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::sync::Arc;
use umbrage_device::Device;

/// In the order of their bindings: the task, then storage buffers.
const WALK: [bool; 8] = [false, false, false, false, true, true, true, false];
const GLANCE: [bool; 8] = [false, false, false, false, false, false, true, true];
const LOOK: [bool; 8] = [false, false, false, false, false, false, true, false];

/// Lanes that share a replicate's rows.
const STRIDES: u32 = 4;

/// Samples whose layers share a word, and where there may be more layers than a byte counts.
const PER_WORD: [u32; 2] = [4, 2];

/// What a pipeline is compiled for.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct LookFor {
    /// Of [`KINDS`].
    pub(super) kind: u32,
    /// The mean's samples or the basis'.
    pub(super) set: u32,
    pub(super) base_rows: u32,
    pub(super) all_rows: u32,
    pub(super) per_row: u32,
    /// Whether there may be more layers than a byte counts.
    pub(super) deep: bool,
}

pub(super) struct Kernel {
    pub(super) pipeline: wgpu::ComputePipeline,
    pub(super) layout: wgpu::BindGroupLayout,
}

/// All that were needed so far.
#[derive(Default)]
pub(super) struct Kernels {
    walks: HashMap<u32, Arc<Kernel>>,
    glances: HashMap<u32, Arc<Kernel>>,
    looks: HashMap<LookFor, Arc<Kernel>>,
}

impl LookFor {
    pub(super) fn new((kind, set): (u32, u32), ruling: &Ruling, deep: bool) -> Self {
        let [base_rows, all_rows, per_row] = ruling.size();
        Self { kind, set, base_rows, all_rows, per_row, deep }
    }
}

impl Kernels {
    pub(super) fn walk(&mut self, device: &Device, kind: u32) -> Arc<Kernel> {
        let compile = || Arc::new(kernel(device, "walk", &walk_source(kind), &WALK));
        self.walks.entry(kind).or_insert_with(compile).clone()
    }

    pub(super) fn glance(&mut self, device: &Device, kind: u32) -> Arc<Kernel> {
        let compile = || Arc::new(kernel(device, "glance", &glance_source(kind), &GLANCE));
        self.glances.entry(kind).or_insert_with(compile).clone()
    }

    pub(super) fn look(&mut self, device: &Device, look: LookFor) -> Arc<Kernel> {
        let compile = || Arc::new(kernel(device, "look", &look_source(&look), &LOOK));
        self.looks.entry(look).or_insert_with(compile).clone()
    }
}

/// The constants that the host and the kernels share.
fn head(kind: u32) -> String {
    let mut head = format!("const KIND = {kind}u;\n");
    for (name, value) in [
        ("LIGHT_GAP", LIGHT_GAP as f32),
        ("COPLANAR", COPLANAR as f32),
        ("MARGIN", MARGIN),
        ("BEYOND", BEYOND),
        ("STEP_LEAST", STEP[0]),
        ("STEP_RANGE", STEP[1]),
    ] {
        // A `String` takes whatever is written.
        let _ = writeln!(head, "const {name}: f32 = {value:e};");
    }
    let _ = writeln!(head, "const PIECES = {PIECES}u;");
    for (number, name) in KINDS.into_iter().enumerate() {
        let _ = writeln!(head, "const {name} = {number}u;");
    }
    head
}

fn walk_source(kind: u32) -> String {
    [
        head(kind).as_str(),
        include_str!("task.wgsl"),
        include_str!("exact.wgsl"),
        include_str!("volume.wgsl"),
        include_str!("facing.wgsl"),
        include_str!("walk.wgsl"),
    ]
    .concat()
}

fn glance_source(kind: u32) -> String {
    [
        head(kind).as_str(),
        include_str!("task.wgsl"),
        include_str!("exact.wgsl"),
        include_str!("sight.wgsl"),
        include_str!("survey.wgsl"),
        include_str!("list.wgsl"),
        include_str!("edges.wgsl"),
        &each("pair", PIECES / 2, include_str!("glance.wgsl")),
    ]
    .concat()
}

fn look_source(look: &LookFor) -> String {
    let per_word = PER_WORD[usize::from(look.deep)];
    let (rows, words) = (look.all_rows.div_ceil(STRIDES), look.per_row.div_ceil(per_word));
    let repeated = |source: &str| each("row", rows, &each("word", words, source));
    let mut constants = head(look.kind);
    for (name, value) in [
        ("SET", look.set),
        ("BASE_ROWS", look.base_rows),
        ("ALL_ROWS", look.all_rows),
        ("PER_ROW", look.per_row),
        ("STRIDES", STRIDES),
        ("FIELDS", per_word),
    ] {
        let _ = writeln!(constants, "const {name} = {value}u;");
    }
    [
        constants.as_str(),
        include_str!("task.wgsl"),
        include_str!("words.wgsl"),
        include_str!("exact.wgsl"),
        include_str!("sight.wgsl"),
        include_str!("survey.wgsl"),
        include_str!("list.wgsl"),
        include_str!("edges.wgsl"),
        include_str!("outline.wgsl"),
        &repeated(include_str!("rows.wgsl")),
        include_str!("places.wgsl"),
        &repeated(include_str!("layers.wgsl")),
        &repeated(include_str!("cover.wgsl")),
        &repeated(include_str!("look.wgsl")),
        &repeated(include_str!("tell.wgsl")),
    ]
    .concat()
}

/// Repeats what is between `// each row` and `// end row` (or `word`, or `pair`), with its number for ROW: neither the
/// language nor wgpu, which bounds loops and indices, keeps rows of an array in registers.
fn each(what: &str, count: u32, source: &str) -> String {
    let [start, end] = [format!("// each {what}\n"), format!("// end {what}\n")];
    let name = what.to_uppercase();
    let [number, suffix] = [format!("{name}u"), format!("_{name}")];
    let mut whole = String::new();
    for (at, part) in source.split(&start).enumerate() {
        let (repeated, rest) = if at == 0 { ("", part) } else { part.split_once(&end).unwrap_or((part, "")) };
        for i in 0..count {
            whole += &repeated.replace(&number, &format!("{i}u")).replace(&suffix, &format!("_{i}"));
        }
        whole += rest;
    }
    whole
}

fn kernel(device: &Device, name: &'static str, source: &str, written: &[bool]) -> Kernel {
    let gpu = &device.device;
    let module = gpu.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(name),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let storage = |&written: &bool| wgpu::BufferBindingType::Storage { read_only: !written };
    let types = std::iter::once(wgpu::BufferBindingType::Uniform).chain(written.iter().map(storage));
    let entries: Vec<wgpu::BindGroupLayoutEntry> = types
        .enumerate()
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding: binding as u32,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        })
        .collect();
    let layout = gpu
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(name), entries: &entries });
    let pipeline_layout = gpu.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(name),
        bind_group_layouts: &[Some(&layout)],
        ..Default::default()
    });
    let pipeline = gpu.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(name),
        layout: Some(&pipeline_layout),
        module: &module,
        entry_point: Some(name),
        compilation_options: wgpu::PipelineCompilationOptions {
            // Everything that is read was written before.
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    });
    Kernel { pipeline, layout }
}
