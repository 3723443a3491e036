//! The passes of one frame as plain data: what a technique writes and `gpu` executes.

use crate::{Fragment, Globals};

/// A texture of a recording.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TextureId(pub usize);

/// What a texel holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// One float.
    R32Float,
    /// Four half floats.
    Rgba16Float,
    /// A depth buffer.
    Depth32Float,
}

/// A texture's shape, and how long its contents last.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct TextureInfo {
    /// For people, dumps and debuggers.
    pub label: &'static str,
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// What a texel holds.
    pub format: Format,
    /// `Some(key)`: contents stay valid as long as the key is the same, and the passes that write
    /// it are skipped then (a static light's map is rendered once a scene).
    pub kept: Option<u64>,
}

/// A resource at its fixed place in group 0 (the same meaning in every shader).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binding {
    /// 0: uniform `globals`.
    Globals,
    /// 1: the shadow map.
    ShadowMap(TextureId),
    /// 2: the camera's linear depth.
    CameraDepth(TextureId),
    /// 3: the camera's normals.
    CameraNormal(TextureId),
    /// 4: anchors to shade.
    Anchors,
    /// 5: the result, a float per receiver.
    Values,
    /// 6: the input of a filter, or a mask to fetch from.
    Source(TextureId),
    /// 7: the target of a pass.
    Destination(TextureId),
    /// 8: a sampler for gathers.
    Nearest,
}

impl Binding {
    /// The WGSL binding number.
    pub fn number(self) -> u32 {
        match self {
            Self::Globals => 0,
            Self::ShadowMap(_) => 1,
            Self::CameraDepth(_) => 2,
            Self::CameraNormal(_) => 3,
            Self::Anchors => 4,
            Self::Values => 5,
            Self::Source(_) => 6,
            Self::Destination(_) => 7,
            Self::Nearest => 8,
        }
    }
}

/// A compute pass.
#[derive(Clone, Debug, PartialEq)]
pub struct ComputePass {
    /// For people, timings and debuggers.
    pub label: &'static str,
    /// WGSL, the pass's own file first.
    pub shader: Vec<Fragment>,
    /// Entry point.
    pub entry: &'static str,
    /// Values of `override` constants; those that the shader does not declare are left out.
    pub constants: Vec<(&'static str, f64)>,
    /// What it reads and writes.
    pub bindings: Vec<Binding>,
    /// Workgroups of 8x8.
    pub groups: [u32; 2],
}

/// A depth rasterisation, the only use of the raster pipeline.
#[derive(Clone, Debug, PartialEq)]
pub struct RasterPass {
    /// For people, timings and debuggers.
    pub label: &'static str,
    /// WGSL with entry points `vertex` and `fragment`.
    pub shader: Vec<Fragment>,
    /// Colour targets with their clear value.
    pub targets: Vec<(TextureId, f64)>,
    /// The depth buffer.
    pub depth: TextureId,
}

/// One pass.
#[derive(Clone, Debug, PartialEq)]
pub enum Pass {
    /// Draws all triangles.
    Raster(RasterPass),
    /// Runs over a grid.
    Compute(ComputePass),
}

impl Pass {
    /// For people, timings and debuggers.
    pub fn label(&self) -> &'static str {
        match self {
            Self::Raster(pass) => pass.label,
            Self::Compute(pass) => pass.label,
        }
    }

    /// The textures that it writes.
    pub fn written(&self) -> Vec<TextureId> {
        match self {
            Self::Raster(pass) => pass.targets.iter().map(|t| t.0).collect(),
            Self::Compute(pass) => {
                let target = |b: &Binding| if let Binding::Destination(t) = b { Some(*t) } else { None };
                pass.bindings.iter().filter_map(target).collect()
            }
        }
    }
}

/// Everything that happens for one frame of one variant.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The uniform block of every pass.
    pub globals: Globals,
    /// All textures.
    pub textures: Vec<TextureInfo>,
    /// All passes, in order. The last writes `Values`.
    pub passes: Vec<Pass>,
}

impl Recording {
    /// An empty recording.
    pub fn new(globals: Globals) -> Self {
        Self { globals, textures: Vec::new(), passes: Vec::new() }
    }

    /// Declares a texture.
    pub fn texture(&mut self, info: TextureInfo) -> TextureId {
        self.textures.push(info);
        TextureId(self.textures.len() - 1)
    }

    /// A texture declared before under this label.
    pub fn find(&self, label: &str) -> Option<TextureId> {
        self.textures.iter().position(|t| t.label == label).map(TextureId)
    }

    /// The shape of a texture.
    pub fn info(&self, texture: TextureId) -> &TextureInfo {
        &self.textures[texture.0]
    }

    /// Adds a compute pass over every texel of its destination.
    pub fn filter(&mut self, pass: ComputePass, destination: TextureId) {
        let info = self.info(destination);
        let groups = [info.width.div_ceil(8), info.height.div_ceil(8)];
        self.passes.push(Pass::Compute(ComputePass { groups, ..pass }));
    }
}
