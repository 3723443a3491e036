//! Everything needed to run it again.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What was run, on what, and how to run it again. Nothing here names a host or a folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Provenance {
    /// Version of the program.
    pub tool_version: String,
    /// When the run was started, as RFC 3339; passed in, because libraries read no clock.
    pub date: String,
    /// The command line to copy.
    pub command: String,
    /// Name of the suite, or of the scene.
    pub suite: String,
    /// What rendered the variants.
    pub adapter: AdapterCard,
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Frames per window, T. Part of the score: only equal T compare.
    pub frames: u32,
    /// Pattern seeds per frame, S, of a variant with randomness.
    pub seeds: u32,
    /// The first of them; other seeds draw other patterns, which a gate allows for.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub first_seed: u32,
    /// Side of a tile in pixels of the middle frame: what intervals are drawn over.
    pub tile_px: u32,
    /// Side of the shadow map in texels.
    pub shadow_map_texels: u32,
    /// How truth was made.
    pub truth: TruthCard,
    /// The scenes.
    pub scenes: Vec<SceneCard>,
    /// Anything else that a reader should know.
    pub notes: Vec<String>,
}

fn is_zero(seed: &u32) -> bool {
    *seed == 0
}

/// What rendered the variants.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct AdapterCard {
    /// As the driver calls it.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Graphics interface: Vulkan, Metal, Dx12.
    pub backend: String,
    /// Kind of device: DiscreteGpu, IntegratedGpu, VirtualGpu, Cpu.
    pub device_type: String,
    /// A software adapter: its times are not a cost.
    pub is_cpu: bool,
}

impl AdapterCard {
    /// The kind of device of frames that another program rendered.
    pub const ELSEWHERE: &str = "none";

    /// Whether an adapter of this machine rendered the variants.
    pub fn rendered_here(&self) -> bool {
        self.device_type != Self::ELSEWHERE
    }

    /// A processor that imitates a GPU.
    pub fn is_software(&self) -> bool {
        self.is_cpu && self.rendered_here()
    }
}

/// How truth was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TruthCard {
    /// Samples a point in each of the two independent halves.
    pub samples_per_half: u32,
    /// Samples a point in the third estimate, the basis of the projection and of the regions.
    pub basis_samples: u32,
    /// Standard error that was wanted at each point; none: as many samples at all points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f32>,
    /// In words: "path traced, Owen-scrambled Sobol".
    pub method: String,
}

/// A scene, by its content.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SceneCard {
    /// Its name.
    pub name: String,
    /// Hash over geometry and light: equal hashes are equal scenes.
    pub content_hash: String,
    /// The light in words: "sun, 2.00 degrees".
    pub light: String,
    /// What the shadow map covers: "orthographic, 30.0 m wide, 14.6 mm a texel".
    pub shadow_map: String,
    /// Dropped triangles and the like.
    pub notes: Vec<String>,
}
