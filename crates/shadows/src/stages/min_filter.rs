//! The nearest depth of a square region of the shadow map (T13): shrunk, then separable.

use crate::recording::{Binding, ComputePass, Recording, TextureId, TextureInfo};
use crate::shader;

/// Settings of the minimum filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MinFilter {
    /// Side of the blocks that the map is first reduced to.
    pub(crate) shrink: u32,
    /// Half-width of the region in reduced texels.
    pub(crate) radius: u32,
}

/// The nearest depth of each block of the map; kept as long as the map is.
pub(crate) fn min_shrink(recording: &mut Recording, map: TextureId, shrink: u32) -> TextureId {
    let mut info = recording.info(map).clone();
    // Kept contents depend on the setting as well as on the map.
    info.kept = info.kept.map(|key| key ^ u64::from(shrink).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    info.width = info.width.div_ceil(shrink);
    info.height = info.height.div_ceil(shrink);
    let shrunk = recording.texture(TextureInfo { label: "min-shrunk", ..info });
    let pass = ComputePass {
        label: "min-shrink",
        shader: vec![shader::MIN_SHRINK],
        entry: "min_shrink",
        constants: vec![("SHRINK", f64::from(shrink))],
        bindings: vec![Binding::Source(map), Binding::Destination(shrunk)],
        groups: [0, 0],
    };
    recording.filter(pass, shrunk);
    shrunk
}

/// Reduces and filters; kept as long as the map is.
pub(crate) fn min_filter(recording: &mut Recording, map: TextureId, settings: MinFilter) -> TextureId {
    let mut source = min_shrink(recording, map, settings.shrink);
    let mut info = recording.info(source).clone();
    info.kept = info.kept.map(|key| key ^ u64::from(settings.radius).wrapping_mul(0xc2b2_ae3d_27d4_eb4f));
    for (axis, label) in ["min-rows", "min-map"].into_iter().enumerate() {
        let destination = recording.texture(TextureInfo { label, ..info.clone() });
        let filter = ComputePass {
            label,
            shader: vec![shader::MIN_AXIS],
            entry: "min_axis",
            constants: vec![("AXIS", axis as f64), ("RADIUS", f64::from(settings.radius))],
            bindings: vec![Binding::Source(source), Binding::Destination(destination)],
            groups: [0, 0],
        };
        recording.filter(filter, destination);
        source = destination;
    }
    source
}
