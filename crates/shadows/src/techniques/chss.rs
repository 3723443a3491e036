//! T11: contact hardening at full resolution (percentage-closer soft shadows).

use crate::calibration::Law;
use crate::shader::{self, Fragment};
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Lights, Recording, Technique};

const OWN: Fragment = Fragment::new("chss", include_str!("chss.wgsl"));

/// Search radius over the largest kernel radius.
const SEARCH_SCALE: f64 = 1.0;

/// Blocker search and filter per pixel.
pub(crate) struct Chss {
    /// Point taps of the blocker search.
    pub(crate) search_taps: u32,
    /// Bilinear-compare taps of the filter.
    pub(crate) filter_taps: u32,
    /// How wide a penumbra is.
    pub(crate) law: Law,
}

/// The first document's own setting.
pub(crate) const CHSS: Chss = Chss { search_taps: 32, filter_taps: 16, law: Law::Standard };

/// Fragments of search and filter.
pub(crate) fn uses() -> Vec<Fragment> {
    vec![shader::HARDEN, shader::BLOCKER_SEARCH, shader::FILTER_DISC, shader::KERNEL_VOGEL]
}

impl Chss {
    /// Constants of search and filter.
    pub(crate) fn constants(&self) -> Vec<(&'static str, f64)> {
        vec![
            ("SEARCH_TAPS", f64::from(self.search_taps)),
            ("SEARCH_SCALE", SEARCH_SCALE),
            ("FILTER_TAPS", f64::from(self.filter_taps)),
        ]
    }

    /// The one pass, wherever it is run.
    pub(super) fn shading(&self) -> Shade {
        Shade {
            uses: uses(),
            constants: self.constants(),
            law: self.law,
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("chss", OWN)
        }
    }
}

impl Technique for Chss {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening at full resolution: blocker search, then filter",
            document: match self.law {
                Law::Squared => "T11a: first document, listing 4",
                Law::Linear => "T11b: first document, listing 5; PCSS (Fernando 2005)",
                Law::Plane => "T11c: excerpt of Real-Time Rendering",
                Law::Distance => "T11d: third document",
                _ => "T11: first document, section 2.1; PCSS (Fernando 2005)",
            },
            options: self.law.describe().into(),
            taps: format!("{} search + {} x 4", self.search_taps, self.filter_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let search = format!("{} x {SEARCH_SCALE:.1}", calibration.largest_radius());
        let kernel = self.law.kernel(calibration, "the blockers' mean depth");
        Kernels::hardening(calibration, search, format!("{kernel}; without a blocker 0"))
    }

    fn lights(&self) -> Lights {
        // A distance alone says nothing about the angle of a light that has a place.
        if self.law == Law::Distance { Lights::Suns } else { Lights::All }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        shade(recording, inputs, self.shading());
    }
}
