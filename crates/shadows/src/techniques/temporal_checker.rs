//! T15: a checkerboard that flips in every frame, with the frame before in its gaps.

use super::checker::{upsampling, zero_below};
use super::chss::CHSS;
use crate::shader::{self, Fragment};
use crate::stages::{Grid, Resolve, depth_prepass, resolve, shade_target};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique, TextureId};

const OWN: Fragment = Fragment::new("temporal_checker", include_str!("temporal_checker.wgsl"));

/// Distance from the receiver's plane over depth up to which the frame before saw the same surface.
/// Less than two pixels' width at 180 rows: what a curved surface may turn away within the one pixel
/// that lies between; what stands off farther is another surface.
const AGREEMENT: f64 = 0.01;

/// Two frames' halves.
pub(crate) struct TemporalChecker;

/// The half of one frame.
fn half(recording: &mut Recording, inputs: &Inputs<'_>) -> TextureId {
    let mut shading = CHSS.shading();
    shading.pattern = Some(shader::PATTERN_IGN_TALL);
    shade_target(recording, inputs, Grid::FlippingCheckerboard, shading)
}

impl Technique for TemporalChecker {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening for every second pixel, the others from the frame before",
            document: "T15: first document, sections 3 and 4.2 (future work)",
            options: "flips in every frame, reprojected".into(),
            taps: format!("({} search + {} x 4) / 2", CHSS.search_taps, CHSS.filter_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let full = CHSS.kernels(calibration);
        let kernel = format!(
            "{}; the pixels of the other colour from the frame before, reprojected and interpolated, where the surface agrees to {AGREEMENT} \
             of its depth; else {}",
            full.kernel,
            upsampling(calibration)
        );
        Kernels { kernel, ..full }
    }

    fn history(&self) -> usize {
        1
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let earlier = inputs.earlier(1);
        let before = half(recording, &earlier);
        let depth_before = depth_prepass(recording, &earlier).depth;
        let packed = half(recording, inputs);
        let mut constants = Grid::FlippingCheckerboard.constants();
        constants.extend([
            ("AGREEMENT", AGREEMENT),
            ("DEPTH_BITS", 32.0),
            ("ZERO_BELOW", zero_below(inputs.calibration)),
        ]);
        let technique = Resolve {
            label: "temporal-checker",
            own: OWN,
            uses: vec![shader::CHECKERBOARD, shader::FILL_CHECKER, inputs.calibration.weight()],
            constants,
            reads: vec![
                Binding::Source(packed),
                Binding::SourceB(before),
                Binding::SourceC(depth_before),
                Binding::Past(1),
            ],
        };
        resolve(recording, inputs, technique);
    }
}
