//! The last pass of every technique, over pixels or anchors.

use super::{depth_prepass, shadow_map};
use crate::recording::{Binding, ComputePass, Pass, Recording, TextureId};
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
    /// A mask or map that it fetches from.
    pub(crate) source: Option<TextureId>,
}

/// Workgroups per row of a dispatch over anchors, as in `receiver_anchor.wgsl`.
const ROW_GROUPS: u32 = 1024;

/// Adds the pass that fills the recording's values.
pub(crate) fn shade(recording: &mut Recording, inputs: &Inputs<'_>, technique: Shade) {
    let map = shadow_map(recording, inputs);
    let (slots, mut constants) = calibration::slots(inputs);
    constants.extend(technique.constants);
    constants.push(("PATTERN_SALT", 0.0));
    let mut fragments = vec![technique.own, shader::ENTRY_SHADE, shader::GLOBALS, shader::TAP];
    fragments.extend(technique.uses);
    fragments.extend(slots);
    if fragments.contains(&shader::PATTERN_IGN) {
        fragments.extend(seed_fragments(inputs.seeding));
    }
    let mut bindings = vec![Binding::Globals, Binding::ShadowMap(map), Binding::Values, Binding::Nearest];
    bindings.extend(technique.source.map(Binding::Source));
    let groups = match inputs.receivers {
        Receivers::Frame => {
            let surfaces = depth_prepass(recording, inputs);
            fragments.extend([shader::SURFACE, shader::RECEIVER_FRAME]);
            bindings.extend([Binding::CameraDepth(surfaces.depth), Binding::CameraNormal(surfaces.normal)]);
            [inputs.view.width.div_ceil(8), inputs.view.height.div_ceil(8)]
        }
        Receivers::Anchors { count } => {
            fragments.push(shader::RECEIVER_ANCHOR);
            bindings.push(Binding::Anchors);
            let groups = count.div_ceil(64);
            [groups.min(ROW_GROUPS), groups.div_ceil(ROW_GROUPS)]
        }
    };
    recording.passes.push(Pass::Compute(ComputePass {
        label: technique.label,
        shader: fragments,
        entry: "shade_receivers",
        constants,
        bindings,
        groups,
    }));
}

/// Interleaved gradient noise with the wanted seeding.
pub(crate) fn pattern_fragments(seeding: Seeding) -> Vec<Fragment> {
    let mut fragments = vec![shader::PATTERN_IGN];
    fragments.extend(seed_fragments(seeding));
    fragments
}

fn seed_fragments(seeding: Seeding) -> Vec<Fragment> {
    match seeding {
        Seeding::Fresh => vec![shader::SEED_FRESH, shader::HASH],
        Seeding::Frozen => vec![shader::SEED_FROZEN, shader::HASH],
        Seeding::Animated => vec![shader::SEED_ANIMATED, shader::HASH],
    }
}
