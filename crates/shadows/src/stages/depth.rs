//! The camera's depth prepass: linear depth and normals.

use crate::recording::{Format, Pass, RasterPass, Recording, TextureId, TextureInfo};
use crate::{Inputs, shader};

/// What the camera sees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surfaces {
    /// Linear depth, R32Float; 0 where nothing is seen.
    pub(crate) depth: TextureId,
    /// Geometric normal towards the viewer.
    pub(crate) normal: TextureId,
}

/// Rasterises the camera's view, once per recording.
pub(crate) fn depth_prepass(recording: &mut Recording, inputs: &Inputs<'_>) -> Surfaces {
    if let (Some(depth), Some(normal)) = (recording.find("camera-depth"), recording.find("camera-normal")) {
        return Surfaces { depth, normal };
    }
    let (width, height) = (inputs.view.width, inputs.view.height);
    let info = |label, format| TextureInfo { label, width, height, format, kept: None };
    let depth = recording.texture(info("camera-depth", Format::R32Float));
    let normal = recording.texture(info("camera-normal", Format::Rgba16Float));
    let buffer = recording.texture(info("camera-depth-buffer", Format::Depth32Float));
    recording.passes.push(Pass::Raster(RasterPass {
        label: "depth-prepass",
        shader: vec![shader::RASTER_CAMERA, shader::GLOBALS],
        targets: vec![(depth, 0.0), (normal, 0.0)],
        depth: buffer,
    }));
    Surfaces { depth, normal }
}
