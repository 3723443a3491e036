//! A last pass that reads no shadow map: it puts together what earlier passes shaded.

use super::{depth_prepass, shade};
use crate::recording::{Binding, ComputePass, Recording};
use crate::shader::{self, Fragment};
use crate::{Calibration, Inputs, Receivers};

/// What a technique adds to the common pass.
pub(crate) struct Resolve {
    /// For people and timings.
    pub(crate) label: &'static str,
    /// The technique's own file, which defines `shade`.
    pub(crate) own: Fragment,
    /// Shared fragments that it calls.
    pub(crate) uses: Vec<Fragment>,
    /// Its constants.
    pub(crate) constants: Vec<(&'static str, f64)>,
    /// What it reads besides the camera's depth.
    pub(crate) reads: Vec<Binding>,
}

/// Adds the pass that fills the recording's values.
pub(crate) fn resolve(recording: &mut Recording, inputs: &Inputs<'_>, technique: Resolve) {
    let mut fragments = vec![technique.own, shader::ENTRY_SHADE, shader::GLOBALS, shader::FRAME_DEPTH];
    fragments.extend(technique.uses);
    let mut bindings = vec![Binding::Globals, Binding::Values];
    bindings.extend(technique.reads);
    if let Receivers::Anchors { .. } = inputs.receivers {
        fragments.push(shader::CAMERA_DEPTH);
        bindings.push(Binding::CameraDepth(depth_prepass(recording, inputs).depth));
    }
    let pass = ComputePass {
        label: technique.label,
        shader: fragments,
        entry: "shade_receivers",
        constants: technique.constants,
        bindings,
        groups: [0, 0],
    };
    shade::over_receivers(recording, inputs, pass);
}

impl Calibration {
    /// Slot `weight` for neighbours of a pixel: the demo's difference of depths, or a distance in
    /// space.
    pub(crate) fn weight(self) -> Fragment {
        match self {
            Self::AsPrinted => shader::WEIGHT_DEPTH,
            Self::LightMatched => shader::WEIGHT_NEAR,
        }
    }
}
