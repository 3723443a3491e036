//! The last pass of every technique, over pixels or anchors.

use super::{depth_prepass, shadow_map};
use crate::calibration::Law;
use crate::recording::{Binding, ComputePass, Pass, Recording};
use crate::shader::{self, Fragment};
use crate::{Inputs, Receivers, Seeding, calibration};

/// What a technique adds to the common pass.
pub(crate) struct Shade {
    /// For people and timings.
    pub(crate) label: &'static str,
    /// The technique's own file, which defines `shade`.
    pub(crate) own: Fragment,
    /// Shared fragments that it calls.
    pub(crate) uses: Vec<Fragment>,
    /// Its constants.
    pub(crate) constants: Vec<(&'static str, f64)>,
    /// Textures that it fetches from, and whatever else it reads.
    pub(crate) reads: Vec<Binding>,
    /// Its law of the penumbra.
    pub(crate) law: Law,
    /// Its pattern, if it calls one.
    pub(crate) pattern: Option<Fragment>,
}

impl Shade {
    /// A pass that calls nothing but the map's taps.
    pub(crate) fn new(label: &'static str, own: Fragment) -> Self {
        let (uses, constants, reads) = (Vec::new(), Vec::new(), Vec::new());
        Self { label, own, uses, constants, reads, law: Law::Standard, pattern: None }
    }
}

/// Workgroups per row of a dispatch over anchors, as in `receiver_anchor.wgsl`.
const ROW_GROUPS: u32 = 1024;

/// Adds the pass that fills the recording's values.
pub(crate) fn shade(recording: &mut Recording, inputs: &Inputs<'_>, technique: Shade) {
    let map = shadow_map(recording, inputs);
    let (slots, mut constants) = calibration::slots(inputs, technique.law);
    constants.extend(technique.constants);
    constants.push(("PATTERN_SALT", 0.0));
    let mut fragments = vec![technique.own, shader::ENTRY_SHADE, shader::GLOBALS, shader::TURN];
    fragments.extend(technique.uses);
    fragments.extend(slots);
    fragments.extend(technique.pattern.into_iter().flat_map(|p| seeded(p, inputs.seeding)));
    let mut bindings = vec![Binding::Globals, Binding::ShadowMap(map), Binding::Values, Binding::Nearest];
    bindings.extend(technique.reads);
    let pass = ComputePass {
        label: technique.label,
        shader: fragments,
        entry: "shade_receivers",
        constants,
        bindings,
        groups: [0, 0],
    };
    over_receivers(recording, inputs, pass);
}

/// Adds a pass over pixels or anchors, with the fragments and bindings that receivers need.
pub(super) fn over_receivers(recording: &mut Recording, inputs: &Inputs<'_>, mut pass: ComputePass) {
    pass.groups = match inputs.receivers {
        Receivers::Frame => {
            let surfaces = depth_prepass(recording, inputs);
            pass.shader.extend([shader::SURFACE, shader::RECEIVER_FRAME]);
            pass.bindings
                .extend([Binding::CameraDepth(surfaces.depth), Binding::CameraNormal(surfaces.normal)]);
            [inputs.view.width.div_ceil(8), inputs.view.height.div_ceil(8)]
        }
        Receivers::Anchors { count } => {
            pass.shader.push(shader::RECEIVER_ANCHOR);
            pass.bindings.push(Binding::Anchors);
            let groups = count.div_ceil(64);
            [groups.min(ROW_GROUPS), groups.div_ceil(ROW_GROUPS)]
        }
    };
    recording.passes.push(Pass::Compute(pass));
}

/// A pattern with the wanted seeding.
pub(crate) fn seeded(pattern: Fragment, seeding: Seeding) -> Vec<Fragment> {
    if pattern == shader::PATTERN_NONE {
        return vec![pattern];
    }
    [vec![pattern], seeds(seeding)].concat()
}

/// What a pattern draws its offsets from.
pub(crate) fn seeds(seeding: Seeding) -> Vec<Fragment> {
    let seed = match seeding {
        Seeding::Fresh => shader::SEED_FRESH,
        Seeding::Frozen => shader::SEED_FROZEN,
        Seeding::Animated => shader::SEED_ANIMATED,
    };
    vec![seed, shader::HASH]
}
