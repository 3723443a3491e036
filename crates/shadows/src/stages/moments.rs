//! Prefiltered shadow maps (T23 to T25, T30): what of each depth is averaged, as a mip chain.

use super::shadow_map;
use crate::recording::{Binding, ComputePass, Format, Recording, TextureId, TextureInfo};
use crate::shader::{self, Fragment};
use crate::{Inputs, LightMap};

/// What of a depth is averaged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Content {
    /// Depth and its square: variance shadow maps. Depth is linear, in units of the far plane's
    /// distance, counted from the middle between the nearest geometry and the far plane.
    Variance,
    /// Its exponential, relative to the far plane.
    Exponential {
        /// Exponent per metre.
        per_metre: f64,
    },
}

/// How far the chain goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Levels {
    /// The map's own texels.
    Finest,
    /// Two halvings: means of 4 x 4 texels.
    Four,
    /// Down to one texel.
    All,
}

impl Content {
    /// Slots `moments_of` and `destination`.
    fn fragments(self) -> Vec<Fragment> {
        match self {
            Self::Variance => vec![shader::MOMENTS_VARIANCE, shader::MOMENT_DEPTH],
            Self::Exponential { .. } => vec![shader::MOMENTS_EXPONENTIAL],
        }
    }

    fn format(self) -> Format {
        match self {
            Self::Variance => Format::Rg32Float,
            Self::Exponential { .. } => Format::R32Float,
        }
    }

    fn constants(self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Variance => vec![],
            Self::Exponential { per_metre } => vec![("ESM_SHARPNESS", per_metre)],
        }
    }

    /// Kept contents depend on it as well as on the map.
    fn salt(self) -> u64 {
        match self {
            Self::Variance => 0x9e37_79b9_7f4a_7c15,
            Self::Exponential { per_metre } => per_metre.to_bits().rotate_left(23),
        }
    }
}

impl Levels {
    fn label(self, content: Content) -> &'static str {
        match (content, self) {
            (Content::Exponential { .. }, _) => "exponential-mips",
            (_, Self::Finest) => "moments",
            (_, Self::Four) => "moments-four",
            (_, Self::All) => "moments-mips",
        }
    }

    /// Levels of a texture of this side, which is a power of two.
    fn count(self, side: u32) -> u32 {
        let all = side.ilog2() + 1;
        match self {
            Self::Finest => 1,
            Self::Four => all.min(3),
            Self::All => all,
        }
    }
}

/// Side of the finest level: the map's, filled up to a power of two with texels of its border.
fn side(light: &LightMap) -> u32 {
    light.texels.next_power_of_two()
}

/// The chain of a shadow map, kept as long as that is.
pub(crate) fn moments(
    recording: &mut Recording,
    inputs: &Inputs<'_>,
    (content, levels): (Content, Levels),
) -> TextureId {
    let map = shadow_map(recording, inputs);
    let (side, label) = (side(inputs.light), levels.label(content));
    let kept = recording.info(map).kept.map(|key| key ^ content.salt());
    let mips = levels.count(side);
    let info = TextureInfo { label, width: side, height: side, format: content.format(), mips, kept };
    let chain = recording.texture(info);
    let pass = |own, entry| {
        let mut shader = vec![own, shader::GLOBALS];
        shader.extend(content.fragments());
        let (constants, bindings) = (content.constants(), Vec::new());
        ComputePass { label, shader, entry, constants, bindings, groups: [0, 0] }
    };
    let bindings = vec![Binding::Globals, Binding::Source(map), Binding::DestinationLevel(chain, 0)];
    let base = ComputePass { bindings, ..pass(shader::MOMENTS_BASE, "moments_base") };
    recording.filter(base, chain);
    for level in 1..mips {
        let (finer, coarser) =
            (Binding::SourceLevel(chain, level - 1), Binding::DestinationLevel(chain, level));
        let bindings = vec![Binding::Globals, finer, coarser];
        let halve = ComputePass { bindings, ..pass(shader::MOMENTS_HALVE, "moments_halve") };
        recording.filter_level(halve, chain, level);
    }
    chain
}

/// Moments of 4 x 4 texels, then a mean of 3 x 3 of those: the fourth document's anti-aliased and
/// filtered map, a quarter as wide.
pub(crate) fn moments_filtered(recording: &mut Recording, inputs: &Inputs<'_>) -> TextureId {
    let chain = moments(recording, inputs, (Content::Variance, Levels::Four));
    let info = recording.info(chain).clone();
    let finest = info.mips - 1;
    let [width, height] = info.size(finest);
    let label = "moments-filtered";
    let kept = info.kept.map(|key| key.rotate_left(9));
    let filtered = recording.texture(TextureInfo { label, width, height, mips: 1, kept, ..info });
    let mut shader = vec![shader::MOMENTS_BOX, shader::GLOBALS];
    shader.extend(Content::Variance.fragments());
    let bindings =
        vec![Binding::Globals, Binding::SourceLevel(chain, finest), Binding::Destination(filtered)];
    let pass =
        ComputePass { label, shader, entry: "moments_box", constants: vec![], bindings, groups: [0, 0] };
    recording.filter(pass, filtered);
    filtered
}
