//! The low-resolution penumbra mask (T12).

use super::{depth_prepass, shade};
use crate::calibration::Law;
use crate::recording::{Binding, ComputePass, Format, Recording, TextureId, TextureInfo};
use crate::{Inputs, calibration, shader};

/// Settings of the mask.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PenumbraMask {
    /// Pixels per mask texel and axis.
    pub(crate) step: u32,
    /// Blocker-search taps.
    pub(crate) taps: u32,
    /// Search radius over filter radius.
    pub(crate) search_scale: f64,
    /// Levels of the stored value; 0 keeps floats.
    pub(crate) levels: u32,
    /// Stored where nothing blocks, over the largest radius.
    pub(crate) without_blocker: f64,
}

/// Kernel radius in map widths per block of pixels, by a search in this map (the shadow map, or one
/// that was reduced from it).
pub(crate) fn penumbra_mask(
    recording: &mut Recording,
    inputs: &Inputs<'_>,
    (settings, map): (PenumbraMask, TextureId),
) -> TextureId {
    let surfaces = depth_prepass(recording, inputs);
    let (width, height) =
        (inputs.view.width.div_ceil(settings.step), inputs.view.height.div_ceil(settings.step));
    let info =
        TextureInfo { label: "penumbra-mask", width, height, format: Format::R32Float, mips: 1, kept: None };
    let mask = recording.texture(info);
    let (slots, mut constants) = calibration::slots(inputs, Law::Standard);
    calibration::set(&mut constants, ("MAP_TEXELS", f64::from(recording.info(map).width)));
    constants.extend([
        ("MASK_STEP", f64::from(settings.step)),
        ("SEARCH_TAPS", f64::from(settings.taps)),
        ("SEARCH_SCALE", settings.search_scale),
        ("MASK_LEVELS", f64::from(settings.levels)),
        ("WITHOUT_BLOCKER", settings.without_blocker),
        // Its noise must not repeat that of the last pass.
        ("PATTERN_SALT", 1.0),
    ]);
    let mut fragments = vec![
        shader::PENUMBRA_MASK,
        shader::GLOBALS,
        shader::SURFACE,
        shader::TURN,
        shader::BLOCKER_SEARCH,
        shader::KERNEL_VOGEL,
    ];
    fragments.extend(slots);
    fragments.extend(shade::seeded(shader::PATTERN_IGN, inputs.seeding));
    let pass = ComputePass {
        label: "penumbra-mask",
        shader: fragments,
        entry: "penumbra_mask",
        constants,
        bindings: vec![
            inputs.own_globals(),
            Binding::ShadowMap(map),
            Binding::CameraDepth(surfaces.depth),
            Binding::CameraNormal(surfaces.normal),
            Binding::Destination(mask),
            Binding::Nearest,
        ],
        groups: [0, 0],
    };
    recording.filter(pass, mask);
    mask
}
