//! T11e: contact hardening that stops where its search has decided.
//!
//! No blocker: lit. Every tap a blocker: dark. Both differ from `chss` where its taps and the texels
//! that its filter would read are not the same: a border between the taps of the search is missed,
//! and a search disc that is dark at every tap may hold lit texels that the filter finds.

use super::chss;
use crate::shader::{self, Fragment};
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("chss_early_out", include_str!("chss_early_out.wgsl"));

/// Kernels of a smaller radius, in texels, take one tap: the bilinear compare is as wide.
const SHARP_TEXELS: f64 = 0.5;

/// `chss` with early-outs.
pub(crate) struct ChssEarlyOut;

impl Technique for ChssEarlyOut {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening that stops where its search has decided",
            document: "T11e: excerpt of Real-Time Rendering",
            options: format!("one tap below {SHARP_TEXELS} texels"),
            taps: "32 search + 0, 1 or 16 x 4".into(),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let chss = chss::CHSS.kernels(calibration);
        let kernel =
            format!("{}; all taps blockers: no filter; below {SHARP_TEXELS} texels one tap", chss.kernel);
        Kernels { kernel, ..chss }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let mut constants = chss::CHSS.constants();
        constants.push(("SHARP_TEXELS", SHARP_TEXELS));
        let technique = Shade {
            uses: vec![shader::BLOCKER_SEARCH, shader::FILTER_DISC, shader::KERNEL_VOGEL],
            constants,
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("chss-early-out", OWN)
        };
        shade(recording, inputs, technique);
    }
}
