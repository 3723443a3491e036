//! The nearest depth of a square region of the shadow map (T13): shrunk, then separable.

use crate::recording::{Binding, ComputePass, Format, Recording, TextureId, TextureInfo};
use crate::shader;

/// Settings of the minimum filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MinFilter {
    /// Side of the blocks that the map is first reduced to.
    pub(crate) shrink: u32,
    /// Half-width of the region in reduced texels.
    pub(crate) radius: u32,
}

/// Reduces and filters; kept as long as the map is.
pub(crate) fn min_filter(recording: &mut Recording, map: TextureId, settings: MinFilter) -> TextureId {
    let mut info = recording.info(map).clone();
    // Kept contents depend on the settings as well as on the map.
    let salt = u64::from(settings.shrink) << 32 | u64::from(settings.radius);
    info.kept = info.kept.map(|key| key ^ salt.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    info.format = Format::R32Float;
    info.width = info.width.div_ceil(settings.shrink);
    info.height = info.height.div_ceil(settings.shrink);
    let mut source = recording.texture(TextureInfo { label: "min-shrunk", ..info.clone() });
    let pass = |label, shader, entry| ComputePass {
        label,
        shader: vec![shader],
        entry,
        constants: vec![],
        bindings: vec![],
        groups: [0, 0],
    };
    let shrink = ComputePass {
        constants: vec![("SHRINK", f64::from(settings.shrink))],
        bindings: vec![Binding::Source(map), Binding::Destination(source)],
        ..pass("min-shrink", shader::MIN_SHRINK, "min_shrink")
    };
    recording.filter(shrink, source);
    for (axis, label) in ["min-rows", "min-map"].into_iter().enumerate() {
        let destination = recording.texture(TextureInfo { label, ..info.clone() });
        let filter = ComputePass {
            constants: vec![("AXIS", axis as f64), ("RADIUS", f64::from(settings.radius))],
            bindings: vec![Binding::Source(source), Binding::Destination(destination)],
            ..pass(label, shader::MIN_AXIS, "min_axis")
        };
        recording.filter(filter, destination);
        source = destination;
    }
    source
}
