//! T28: blocker search by moments, percentage-closer filtering for the shadow.

use super::vsm_search::SEARCH_SCALE;
use crate::shader::{self, Fragment};
use crate::stages::{Area, Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("vsm_pcf", include_str!("vsm_pcf.wgsl"));

/// Search by mips, filter on Vogel's disc.
pub(crate) struct VsmPcf {
    /// Bilinear-compare taps of the filter.
    pub(crate) filter_taps: u32,
}

impl Technique for VsmPcf {
    fn info(&self) -> Info {
        Info {
            title: "blocker search by moments, filter by comparisons",
            document: "T28: third document, conclusion",
            options: format!(
                "search: {}; Vogel disc turned by interleaved gradient noise",
                Area::Mips.describe()
            ),
            taps: format!("{} search + {} x 4", Area::Mips.taps(), self.filter_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        Kernels::moments_disc(calibration, SEARCH_SCALE)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let technique = Shade {
            uses: vec![shader::MOMENTS_SEARCH, shader::CHEBYSHEV, shader::FILTER_DISC, shader::KERNEL_VOGEL],
            constants: vec![("SEARCH_SCALE", SEARCH_SCALE), ("FILTER_TAPS", f64::from(self.filter_taps))],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("vsm-pcf", OWN)
        };
        let technique = Area::Mips.read_by(technique, recording, inputs);
        shade(recording, inputs, technique);
    }
}
