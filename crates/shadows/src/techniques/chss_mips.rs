//! T17: contact hardening whose far taps read coarser levels of the shadow map.
//!
//! A level holds mean depths. Where a blocker's border crosses a coarse texel, its mean lies between
//! blocker and receiver: the search then finds blockers that are not there.

use super::chss;
use crate::shader::{self, Fragment};
use crate::stages::{Reduction, Shade, pyramid, shade, shadow_map};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("chss_mips", include_str!("chss_mips.wgsl"));

/// Distance from the centre, in texels, over which a tap's level is counted.
const FAR_TEXELS: f64 = 4.0;

/// Levels beyond the map itself.
const LEVELS: u32 = 2;

/// `chss` over three levels of the map.
pub(crate) struct ChssMips;

impl Technique for ChssMips {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening whose far taps read coarser levels of the map",
            document: "T17: first document, future work",
            options: format!("level floor(log2(texels / {FAR_TEXELS})), 0 to {LEVELS}"),
            taps: chss::CHSS.info().taps,
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        chss::CHSS.kernels(calibration)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let map = shadow_map(recording, inputs);
        let levels = pyramid(recording, map, (Reduction::Mean, LEVELS));
        let mut constants = chss::CHSS.constants();
        constants.push(("FAR_TEXELS", FAR_TEXELS));
        let technique = Shade {
            uses: vec![shader::TAP_LEVEL, shader::KERNEL_VOGEL],
            constants,
            reads: vec![Binding::Source(levels)],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("chss-mips", OWN)
        };
        shade(recording, inputs, technique);
    }
}
