//! T11: contact hardening at full resolution (percentage-closer soft shadows).

use crate::shader::{self, Fragment};
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("chss", include_str!("chss.wgsl"));

/// Search radius over the largest kernel radius.
const SEARCH_SCALE: f64 = 1.0;

/// Blocker search and filter per pixel.
pub(crate) struct Chss {
    /// Point taps of the blocker search.
    pub(crate) search_taps: u32,
    /// Bilinear-compare taps of the filter.
    pub(crate) filter_taps: u32,
}

impl Technique for Chss {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening at full resolution: blocker search, then filter",
            document: "T11: first document, section 2.1; PCSS (Fernando 2005)",
            taps: format!("{} search + {} x 4", self.search_taps, self.filter_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let search = format!("{} x {SEARCH_SCALE:.1}", calibration.largest_radius());
        let kernel = format!("{}; without a blocker 0", calibration.radius_for("the blockers' mean depth"));
        Kernels::hardening(calibration, search, kernel)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let technique = Shade {
            label: "chss",
            own: OWN,
            uses: vec![
                shader::BLOCKER_SEARCH,
                shader::FILTER_DISC,
                shader::KERNEL_VOGEL,
                shader::PATTERN_IGN,
            ],
            constants: vec![
                ("SEARCH_TAPS", f64::from(self.search_taps)),
                ("SEARCH_SCALE", SEARCH_SCALE),
                ("FILTER_TAPS", f64::from(self.filter_taps)),
            ],
            source: None,
        };
        shade(recording, inputs, technique);
    }
}
