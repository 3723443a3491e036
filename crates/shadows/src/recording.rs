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
    /// Two floats: moments of depth.
    Rg32Float,
    /// Two integers: sums of moments, which may wrap.
    Rg32Uint,
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
    /// Levels, each half as wide and high as the one before; 1 for most.
    pub mips: u32,
    /// `Some(key)`: contents stay valid as long as the key is the same, and the passes that write
    /// it are skipped then (a static light's map is rendered once a scene).
    pub kept: Option<u64>,
}

/// A resource at its fixed place in group 0 (the same meaning in every shader).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binding {
    /// 0: uniform `globals`.
    Globals,
    /// 0: those of so many frames ago (1, 2, ...), for a pass that belongs to that frame.
    EarlierGlobals(usize),
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
    /// 6: one level of it.
    SourceLevel(TextureId, u32),
    /// 7: one level of it.
    DestinationLevel(TextureId, u32),
    /// 8: a sampler for gathers.
    Nearest,
    /// 9: a second texture to fetch from.
    SourceB(TextureId),
    /// 10: a third.
    SourceC(TextureId),
    /// 11: uniform `past`, the globals of so many frames ago, beside the present ones.
    Past(usize),
    /// 12: masks of cut-out surfaces.
    Cutouts,
}

impl Binding {
    /// The WGSL binding number.
    pub fn number(self) -> u32 {
        match self {
            Self::Globals | Self::EarlierGlobals(_) => 0,
            Self::ShadowMap(_) => 1,
            Self::CameraDepth(_) => 2,
            Self::CameraNormal(_) => 3,
            Self::Anchors => 4,
            Self::Values => 5,
            Self::Source(_) | Self::SourceLevel(..) => 6,
            Self::Destination(_) | Self::DestinationLevel(..) => 7,
            Self::Nearest => 8,
            Self::SourceB(_) => 9,
            Self::SourceC(_) => 10,
            Self::Past(_) => 11,
            Self::Cutouts => 12,
        }
    }

    /// The texture behind it, if there is one, and its only level, if it is one of several.
    pub fn texture(self) -> Option<(TextureId, Option<u32>)> {
        match self {
            Self::ShadowMap(t)
            | Self::CameraDepth(t)
            | Self::CameraNormal(t)
            | Self::Source(t)
            | Self::SourceB(t)
            | Self::SourceC(t)
            | Self::Destination(t) => Some((t, None)),
            Self::SourceLevel(t, level) | Self::DestinationLevel(t, level) => Some((t, Some(level))),
            Self::Globals
            | Self::EarlierGlobals(_)
            | Self::Past(_)
            | Self::Cutouts
            | Self::Anchors
            | Self::Values
            | Self::Nearest => None,
        }
    }

    /// Whether a pass writes it.
    pub fn is_destination(self) -> bool {
        matches!(self, Self::Destination(_) | Self::DestinationLevel(..))
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
    /// The same for triangles that are cut out, drawn after the others; it reads `Cutouts` besides. Empty
    /// where all are whole.
    pub cut: Vec<Fragment>,
    /// Values of `override` constants; those that the shader does not declare are left out.
    pub constants: Vec<(&'static str, f64)>,
    /// What it reads.
    pub bindings: Vec<Binding>,
    /// Colour targets with their clear value.
    pub targets: Vec<(TextureId, f64)>,
    /// The depth buffer.
    pub depth: TextureId,
    /// The part of the targets that it draws to: x, y, width, height. Only the pass that starts at
    /// the corner clears, and it clears all of them.
    pub viewport: Option<[u32; 4]>,
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

    /// Whether it belongs to an earlier frame: made again for a history, and no cost of this frame.
    pub fn is_earlier(&self) -> bool {
        self.label().starts_with(EARLIER)
    }

    /// The textures that it writes.
    pub fn written(&self) -> Vec<TextureId> {
        match self {
            Self::Raster(pass) => pass.targets.iter().map(|t| t.0).collect(),
            Self::Compute(pass) => {
                let targets = pass.bindings.iter().filter(|b| b.is_destination());
                targets.filter_map(|b| Some(b.texture()?.0)).collect()
            }
        }
    }
}

/// How labels of passes and textures of earlier frames begin.
pub(crate) const EARLIER: &str = "earlier-";

/// Everything that happens for one frame of one variant.
#[derive(Clone, Debug)]
pub struct Recording {
    /// The uniform block of every pass.
    pub globals: Globals,
    /// Those of the frames before, newest first, for techniques with a history.
    pub earlier: Vec<Globals>,
    /// All textures.
    pub textures: Vec<TextureInfo>,
    /// All passes, in order. The last writes `Values`.
    pub passes: Vec<Pass>,
}

impl Recording {
    /// An empty recording.
    pub fn new(globals: Globals) -> Self {
        Self { globals, earlier: Vec::new(), textures: Vec::new(), passes: Vec::new() }
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
        self.filter_level(pass, destination, 0);
    }

    /// Adds a compute pass over every texel of one level of its destination.
    pub fn filter_level(&mut self, pass: ComputePass, destination: TextureId, level: u32) {
        let [width, height] = self.info(destination).size(level);
        let groups = [width.div_ceil(8), height.div_ceil(8)];
        self.passes.push(Pass::Compute(ComputePass { groups, ..pass }));
    }
}

impl TextureInfo {
    /// Texels of a level.
    pub fn size(&self, level: u32) -> [u32; 2] {
        [self.width, self.height].map(|side| (side >> level).max(1))
    }
}
