//! T7 and T8: bilinear-compare taps on Vogel's disc, fixed or rotated per pixel.

use crate::shader::{self, Fragment};
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("pcf_vogel", include_str!("pcf_vogel.wgsl"));

/// How the disc is turned from pixel to pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rotation {
    /// Not at all.
    Fixed,
    /// By interleaved gradient noise.
    Ign,
}

/// Percentage-closer filtering on a disc of fixed size.
pub(crate) struct PcfVogel {
    /// Bilinear-compare taps.
    pub(crate) taps: u32,
    /// How the disc is turned.
    pub(crate) rotation: Rotation,
}

impl Technique for PcfVogel {
    fn info(&self) -> Info {
        let (title, document) = match self.rotation {
            Rotation::Fixed => {
                ("PCF: Vogel disc of fixed size, the same at every pixel", "T7: first document, section 1.1")
            }
            Rotation::Ign => (
                "PCF: Vogel disc of fixed size, turned per pixel by interleaved gradient noise",
                "T8: first document, section 1.2",
            ),
        };
        let stochastic = self.rotation == Rotation::Ign;
        Info { title, document, taps: format!("{} x 4", self.taps), stochastic }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        Kernels::fixed_disc(calibration)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let pattern = match self.rotation {
            Rotation::Fixed => shader::PATTERN_NONE,
            Rotation::Ign => shader::PATTERN_IGN,
        };
        let technique = Shade {
            label: "pcf-vogel",
            own: OWN,
            uses: vec![shader::FILTER_DISC, shader::KERNEL_VOGEL, pattern],
            constants: vec![("FILTER_TAPS", f64::from(self.taps))],
            source: None,
        };
        shade(recording, inputs, technique);
    }
}
