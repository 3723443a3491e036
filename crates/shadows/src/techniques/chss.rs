//! T11: contact hardening at full resolution (percentage-closer soft shadows).

use crate::shader::{self, Fragment};
use crate::stages::{Shade, shade};
use crate::{Info, Inputs, Recording, Technique};

const OWN: Fragment = Fragment::new("chss", include_str!("chss.wgsl"));

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
                ("SEARCH_SCALE", 1.0),
                ("FILTER_TAPS", f64::from(self.filter_taps)),
            ],
            source: None,
        };
        shade(recording, inputs, technique);
    }
}
