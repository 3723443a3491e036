//! Pyramids of the shadow map: of least and largest depth (T19), of mean depth (T17, T18).
//!
//! Their level 0 halves the map: nobody asks a pyramid about single texels. A texel of the level
//! that halves the map k times stands for 2^k x 2^k texels of the map, counted from the map's
//! corner, whatever the map's side: no place has to be scaled.

use crate::recording::{Binding, ComputePass, Format, Recording, TextureId, TextureInfo};
use crate::shader::{self, Fragment};

/// What a texel says of those below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reduction {
    /// Least and largest depth. What an odd side leaves over belongs to the last row and column,
    /// so that every texel of the map is counted.
    MinMax,
    /// Mean depth of 2x2. What an odd side leaves over is left out.
    Mean,
}

impl Reduction {
    /// Label, shader and its entry point, format.
    fn parts(self) -> (&'static str, Fragment, &'static str, Format) {
        match self {
            Self::MinMax => ("min-max", shader::MIN_MAX_LEVEL, "min_max_level", Format::Rg32Float),
            Self::Mean => ("mean-depth", shader::MEAN_LEVEL, "mean_level", Format::R32Float),
        }
    }
}

/// Builds so many levels, or as many as there are; kept as long as the map is.
pub(crate) fn pyramid(
    recording: &mut Recording,
    map: TextureId,
    (reduction, levels): (Reduction, u32),
) -> TextureId {
    let (label, shader, entry, format) = reduction.parts();
    if let Some(built) = recording.find(label) {
        return built;
    }
    let mut info = TextureInfo { label, format, ..recording.info(map).clone() };
    [info.width, info.height] = info.size(1);
    info.mips = levels.min(all_levels(info.width.min(info.height)));
    // Kept contents depend on the number of levels as well as on the map.
    info.kept = info.kept.map(|key| key ^ u64::from(info.mips).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let mips = info.mips;
    let destination = recording.texture(info);
    for level in 0..mips {
        let source = match level {
            0 => Binding::Source(map),
            _ => Binding::SourceLevel(destination, level - 1),
        };
        let pass = ComputePass {
            label,
            shader: vec![shader.clone()],
            entry,
            constants: vec![("OF_THE_MAP", f64::from(u32::from(level == 0)))],
            bindings: vec![source, Binding::DestinationLevel(destination, level)],
            groups: [0, 0],
        };
        recording.filter_level(pass, destination, level);
    }
    destination
}

/// Levels from a side down to one texel.
fn all_levels(side: u32) -> u32 {
    side.max(1).ilog2() + 1
}
