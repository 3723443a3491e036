//! T2: bilinearly interpolated comparison of the four texels round a receiver.

use crate::shader::Fragment;
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("lerp", include_str!("lerp.wgsl"));

/// Which base texel the four comparisons start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Base {
    /// `floor(t - .5)`: mended.
    Mended,
    /// `floor(t + .5)`: as listed, one texel off on each axis.
    Listing,
}

/// Interpolated comparison.
pub(crate) struct Lerp {
    pub(crate) base: Base,
}

impl Technique for Lerp {
    fn info(&self) -> Info {
        Info {
            title: "bilinearly interpolated comparison of four texels",
            document: "T2: fourth document, interpolated shadowing",
            options: match self.base {
                Base::Mended => "base texel floor(t - .5)".into(),
                Base::Listing => "seed defect: base floor(t + .5), displaced by a texel on each axis".into(),
            },
            taps: "4".into(),
            stochastic: false,
        }
    }

    fn kernels(&self, _: Calibration) -> Kernels {
        Kernels::texels("two by two texels, weighted bilinearly")
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let listing = f64::from(u8::from(self.base == Base::Listing));
        let constants = vec![("LISTING", listing)];
        shade(recording, inputs, Shade { constants, ..Shade::new("lerp", OWN) });
    }
}
