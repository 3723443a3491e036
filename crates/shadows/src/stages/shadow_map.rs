//! The light's depth map, kept as long as light and geometry stand still.

use crate::recording::{Format, Pass, RasterPass, Recording, TextureId, TextureInfo};
use crate::{Inputs, shader};

/// Linear depth in metres from the light; texels that nothing covers hold the far plane, so that
/// they never block (the first document's demo clears to 1, closer than anything: TECHNIQUES 2).
pub(crate) fn shadow_map(recording: &mut Recording, inputs: &Inputs<'_>) -> TextureId {
    if let Some(map) = recording.find("shadow-map") {
        return map;
    }
    let side = inputs.light.texels;
    let kept = Some(inputs.light.key() ^ inputs.geometry_key);
    let info = |label, format| TextureInfo { label, width: side, height: side, format, kept };
    let map = recording.texture(info("shadow-map", Format::R32Float));
    let buffer =
        recording.texture(TextureInfo { kept: None, ..info("shadow-depth-buffer", Format::Depth32Float) });
    recording.passes.push(Pass::Raster(RasterPass {
        label: "shadow-map",
        shader: vec![shader::RASTER_SHADOW, shader::GLOBALS],
        targets: vec![(map, f64::from(inputs.light.far))],
        depth: buffer,
    }));
    map
}
