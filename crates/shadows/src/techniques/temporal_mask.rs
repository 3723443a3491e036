//! T16: a penumbra mask at full resolution that four frames fill in turn.

use super::chss_mask::{self, ChssMask};
use crate::calibration::Law;
use crate::recording::{ComputePass, Format, Pass, TextureInfo};
use crate::shader::{self, Fragment};
use crate::stages::{blur, depth_prepass, seeded, shade, shadow_map};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique, TextureId, calibration};

const OWN: Fragment = Fragment::new("temporal_mask", include_str!("temporal_mask.wgsl"));

/// Frames before the present one whose part of the mask is still there.
const HISTORY: usize = 3;

/// Labels of the passes, by how many frames ago it was.
const LABELS: [&str; HISTORY + 1] =
    ["temporal-mask", "earlier-1-temporal-mask", "earlier-2-temporal-mask", "earlier-3-temporal-mask"];

/// The document's mask path with a mask texel per pixel.
const MASK: ChssMask = ChssMask { step: 1, ..chss_mask::PRINTED };

/// A quarter of the mask a frame.
pub(crate) struct TemporalMask;

/// Adds the pass that fills one frame's quarter.
fn quarter(recording: &mut Recording, inputs: &Inputs<'_>, mask: TextureId) {
    let map = shadow_map(recording, inputs);
    let surfaces = depth_prepass(recording, inputs);
    let (slots, mut constants) = calibration::slots(inputs, Law::Standard);
    constants.extend([
        ("SEARCH_TAPS", f64::from(MASK.search_taps)),
        ("SEARCH_SCALE", MASK.search_scale),
        ("MASK_LEVELS", f64::from(chss_mask::levels(inputs.calibration))),
        // Its noise must not repeat that of the last pass.
        ("PATTERN_SALT", 1.0),
    ]);
    let mut fragments = vec![
        OWN,
        shader::GLOBALS,
        shader::SURFACE,
        shader::TURN,
        shader::BLOCKER_SEARCH,
        shader::KERNEL_VOGEL,
    ];
    fragments.extend(slots);
    fragments.extend(seeded(shader::PATTERN_IGN, inputs.seeding));
    let quads = [inputs.view.width, inputs.view.height].map(|side| side.div_ceil(2));
    recording.passes.push(Pass::Compute(ComputePass {
        label: LABELS[inputs.age],
        shader: fragments,
        entry: "temporal_mask",
        constants,
        bindings: vec![
            inputs.own_globals(),
            Binding::ShadowMap(map),
            Binding::CameraDepth(surfaces.depth),
            Binding::CameraNormal(surfaces.normal),
            Binding::Destination(mask),
            Binding::Nearest,
        ],
        groups: quads.map(|side| side.div_ceil(8)),
    }));
}

impl Technique for TemporalMask {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening with a full-resolution penumbra mask that four frames fill in turn",
            document: "T16: first document, section 4.2 (future work)",
            options: "one pixel of 2x2 a frame, no reprojection".into(),
            taps: format!("{} search / 4 + {} x 4", MASK.search_taps, MASK.filter_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let full = MASK.kernels(calibration);
        let kernel = format!("{}; one pixel of 2x2 a frame, the others as old as three frames", full.kernel);
        Kernels { kernel, ..full }
    }

    fn history(&self) -> usize {
        HISTORY
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let mask = recording.texture(TextureInfo {
            label: "penumbra-mask",
            width: inputs.view.width,
            height: inputs.view.height,
            format: Format::R32Float,
            mips: 1,
            kept: None,
        });
        for age in (1..=HISTORY).rev() {
            quarter(recording, &inputs.earlier(age), mask);
        }
        quarter(recording, inputs, mask);
        let blurred = blur(recording, mask, chss_mask::BLUR);
        shade(recording, inputs, MASK.shading(blurred));
    }
}
