//! A probe for performance work: what the plain filter fetches, without what it computes.

use crate::shader::{self, Fragment};
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("pcf_fetches", include_str!("pcf_fetches.wgsl"));

/// The gathers of a rotated Vogel disc.
pub(crate) struct PcfFetches {
    /// How many.
    pub(crate) taps: u32,
}

impl Technique for PcfFetches {
    fn info(&self) -> Info {
        Info {
            title: "the fetches of a rotated Vogel disc, summed: no shadow",
            document: "a probe: docs/performance.md",
            options: String::new(),
            taps: format!("{} x 4", self.taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        Kernels::fixed_disc(calibration)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let technique = Shade {
            uses: vec![shader::KERNEL_VOGEL],
            constants: vec![("FILTER_TAPS", f64::from(self.taps))],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("pcf-fetches", OWN)
        };
        shade(recording, inputs, technique);
    }
}
