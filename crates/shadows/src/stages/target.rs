//! Fewer pixels: a technique's shadow for some pixels of the frame, in a target of its own.

use super::{Shade, depth_prepass, shade, shadow_map};
use crate::recording::{Binding, ComputePass, Format, Recording, TextureId, TextureInfo};
use crate::shader::{self, Fragment};
use crate::{Inputs, calibration};

/// Which pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Grid {
    /// All of them.
    Whole,
    /// Every second one, in a target half as wide.
    Checkerboard,
    /// The same, and in every second frame the others.
    FlippingCheckerboard,
    /// As many on a side as this fraction of the frame's, rounded up.
    Scaled {
        /// Texels of the target...
        numerator: u32,
        /// ... on so many pixels.
        denominator: u32,
    },
}

/// Labels of target and pass, by how many frames ago it was.
const CHECKER_LABELS: [&str; 2] = ["lit-checker", "earlier-1-lit-checker"];

impl Grid {
    /// Fragments that know its layout.
    pub(crate) fn fragments(self) -> Vec<Fragment> {
        match self {
            Self::Whole => vec![shader::WHOLE],
            Self::Checkerboard | Self::FlippingCheckerboard => vec![shader::CHECKERBOARD],
            Self::Scaled { .. } => vec![shader::TARGET_SCALED],
        }
    }

    /// Their constants.
    pub(crate) fn constants(self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Whole => Vec::new(),
            Self::Checkerboard => vec![("FLIPS", 0.0)],
            Self::FlippingCheckerboard => vec![("FLIPS", 1.0)],
            Self::Scaled { numerator, denominator } => {
                vec![("SCALE_NUMERATOR", numerator.into()), ("SCALE_DENOMINATOR", denominator.into())]
            }
        }
    }

    /// Of the target for a frame of these inputs.
    fn info(self, inputs: &Inputs<'_>) -> TextureInfo {
        let (width, height) = (inputs.view.width, inputs.view.height);
        let (label, width, height) = match self {
            Self::Whole => ("lit-whole", width, height),
            Self::Checkerboard | Self::FlippingCheckerboard => {
                (CHECKER_LABELS[inputs.age], width.div_ceil(2), height)
            }
            Self::Scaled { numerator, denominator } => {
                let scaled = |side: u32| (side * numerator).div_ceil(denominator);
                ("lit-low", scaled(width), scaled(height))
            }
        };
        TextureInfo { label, width, height, format: Format::R32Float, mips: 1, kept: None }
    }
}

/// Adds a pass that shades the grid's pixels, and returns its target: the unoccluded fraction of
/// the light, 1 where nothing is seen.
pub(crate) fn shade_target(
    recording: &mut Recording,
    inputs: &Inputs<'_>,
    grid: Grid,
    technique: Shade,
) -> TextureId {
    let map = shadow_map(recording, inputs);
    let surfaces = depth_prepass(recording, inputs);
    let info = grid.info(inputs);
    let label = info.label;
    let target = recording.texture(info);
    let (slots, mut constants) = calibration::slots(inputs, technique.law);
    constants.extend(technique.constants);
    constants.extend(grid.constants());
    constants.push(("PATTERN_SALT", 0.0));
    let mut fragments =
        vec![technique.own, shader::ENTRY_TARGET, shader::GLOBALS, shader::SURFACE, shader::TURN];
    fragments.extend(grid.fragments());
    fragments.extend(technique.uses);
    fragments.extend(slots);
    fragments.extend(technique.pattern.into_iter().flat_map(|p| shade::seeded(p, inputs.seeding)));
    let mut bindings = vec![
        inputs.own_globals(),
        Binding::ShadowMap(map),
        Binding::CameraDepth(surfaces.depth),
        Binding::CameraNormal(surfaces.normal),
        Binding::Destination(target),
        Binding::Nearest,
    ];
    bindings.extend(technique.reads);
    let entry = "shade_target";
    let pass = ComputePass { label, shader: fragments, entry, constants, bindings, groups: [0, 0] };
    recording.filter(pass, target);
    target
}
