//! The light's depth map, kept as long as light and geometry stand still.

use crate::recording::{Binding, Format, Pass, RasterPass, Recording, TextureId, TextureInfo};
use crate::{Inputs, LightKind, shader};

/// Linear depth in metres from the light; texels that nothing covers hold the far plane, so that
/// they never block (the first document's demo clears to 1, closer than anything: TECHNIQUES 2).
pub(crate) fn shadow_map(recording: &mut Recording, inputs: &Inputs<'_>) -> TextureId {
    shadow_map_cleared(recording, inputs, f64::from(inputs.light.far))
}

/// The same with another depth where nothing is.
pub(crate) fn shadow_map_cleared(recording: &mut Recording, inputs: &Inputs<'_>, clear: f64) -> TextureId {
    if let Some(map) = recording.find("shadow-map") {
        return map;
    }
    let [width, height] = inputs.light.size();
    let kept = Some(inputs.light.key() ^ inputs.geometry_key ^ clear.to_bits().rotate_left(17));
    let info = |label, format| TextureInfo { label, width, height, format, mips: 1, kept };
    let map = recording.texture(info("shadow-map", Format::R32Float));
    let depth =
        recording.texture(TextureInfo { kept: None, ..info("shadow-depth-buffer", Format::Depth32Float) });
    let pass = |label, shader| RasterPass {
        label,
        shader: vec![shader, shader::GLOBALS],
        cut: inputs.cut(shader::RASTER_SHADOW_CUT, &[]),
        constants: vec![],
        bindings: vec![Binding::Globals],
        targets: vec![(map, clear)],
        depth,
        viewport: None,
    };
    if inputs.light.kind != LightKind::Cube {
        recording.passes.push(Pass::Raster(pass("shadow-map", shader::RASTER_SHADOW)));
        return map;
    }
    let side = inputs.light.face_texels();
    for (face, label) in FACES.into_iter().enumerate() {
        let index = face as u32;
        recording.passes.push(Pass::Raster(RasterPass {
            shader: vec![shader::RASTER_CUBE, shader::GLOBALS, shader::CUBE_FACES],
            cut: inputs.cut(shader::RASTER_CUBE_CUT, &[shader::CUBE_FACES]),
            constants: vec![("FACE", face as f64)],
            viewport: Some([index % 3 * side, index / 3 * side, side, side]),
            ..pass(label, shader::RASTER_CUBE)
        }));
    }
    map
}

/// Passes of a cube's faces, in the order of `cube_faces.wgsl`.
const FACES: [&str; 6] = [
    "shadow-face-+x",
    "shadow-face--x",
    "shadow-face-+y",
    "shadow-face--y",
    "shadow-face-+z",
    "shadow-face--z",
];
