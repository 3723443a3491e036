//! The camera's depth prepass: linear depth and normals.

use crate::recording::{Format, Pass, RasterPass, Recording, TextureId, TextureInfo};
use crate::{Inputs, shader};
use umbrage_frame::View;

/// What the camera sees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surfaces {
    /// Linear depth, R32Float; 0 where nothing is seen.
    pub(crate) depth: TextureId,
    /// Geometric normal towards the viewer.
    pub(crate) normal: TextureId,
}

/// Labels of depth, normals, depth buffer and pass, by how many frames ago it was.
const LABELS: [[&str; 4]; 4] = [
    ["camera-depth", "camera-normal", "camera-depth-buffer", "depth-prepass"],
    ["earlier-1-depth", "earlier-1-normal", "earlier-1-depth-buffer", "earlier-1-depth-prepass"],
    ["earlier-2-depth", "earlier-2-normal", "earlier-2-depth-buffer", "earlier-2-depth-prepass"],
    ["earlier-3-depth", "earlier-3-normal", "earlier-3-depth-buffer", "earlier-3-depth-prepass"],
];

/// Rasterises the camera's view, once per recording and frame of the history.
pub(crate) fn depth_prepass(recording: &mut Recording, inputs: &Inputs<'_>) -> Surfaces {
    let [depth, normal, buffer, pass] = LABELS[inputs.age];
    if let (Some(depth), Some(normal)) = (recording.find(depth), recording.find(normal)) {
        return Surfaces { depth, normal };
    }
    let (width, height) = (inputs.view.width, inputs.view.height);
    // The seeds and variants of one frame see the same surfaces.
    let kept = Some(view_key(inputs.view) ^ inputs.geometry_key);
    let info = |label, format| TextureInfo { label, width, height, format, mips: 1, kept };
    let depth = recording.texture(info(depth, Format::R32Float));
    let normal = recording.texture(info(normal, Format::Rgba16Float));
    let buffer = recording.texture(TextureInfo { kept: None, ..info(buffer, Format::Depth32Float) });
    recording.passes.push(Pass::Raster(RasterPass {
        label: pass,
        shader: vec![shader::RASTER_CAMERA, shader::GLOBALS],
        cut: inputs.cut(shader::RASTER_CAMERA_CUT, &[]),
        constants: vec![],
        bindings: vec![inputs.own_globals()],
        targets: vec![(depth, 0.0), (normal, 0.0)],
        depth: buffer,
        viewport: None,
    }));
    Surfaces { depth, normal }
}

/// Identifies what a view sees of a geometry.
fn view_key(view: &View) -> u64 {
    let matrices = [view.clip_from_world, view.camera_from_world];
    let words = matrices.iter().flat_map(|m| m.to_cols_array()).map(f32::to_bits);
    let seed = u64::from(view.width) << 32 | u64::from(view.height);
    words.fold(seed, |hash, w| (hash ^ u64::from(w)).wrapping_mul(0x0100_0000_01b3).rotate_left(23))
}
