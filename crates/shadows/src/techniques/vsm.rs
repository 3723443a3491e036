//! T23 to T25: variance shadow maps with a filter of one size.

use crate::shader::{self, Fragment};
use crate::stages::{Area, Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("vsm", include_str!("vsm.wgsl"));

/// What moments say about the lit share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bound {
    /// Chebyshev's.
    Plain,
    /// Its upper four fifths: less bleeding, narrower penumbrae.
    Reduced,
    /// The fourth document's function, with a soft comparison and its defect.
    Listing,
    /// The same with a floor above zero, as it was meant.
    Soft,
}

/// One lookup, one bound.
pub(crate) struct Vsm {
    pub(crate) area: Area,
    pub(crate) bound: Bound,
}

/// The fourth document's reduction of light bleeding: bounds below this count as shadow.
const BLEEDING: f64 = 0.2;

impl Bound {
    fn describe(self) -> &'static str {
        match self {
            Self::Plain => "Chebyshev's bound",
            Self::Reduced => "Chebyshev's bound, linstep(0.2, 1) against light bleeding",
            Self::Listing => {
                "seed defect: variance floor -0.001; smoothstep(z - 0.02, z) and linstep(0.2, 1) as printed"
            }
            Self::Soft => "the listing mended: variance floor +0.001",
        }
    }

    /// Slot `lit_share` and what it calls.
    fn fragments(self) -> Vec<Fragment> {
        match self {
            Self::Plain | Self::Reduced => vec![shader::BOUND_REDUCED, shader::CHEBYSHEV],
            Self::Listing | Self::Soft => vec![shader::BOUND_LISTING],
        }
    }

    /// Smallest variance of the fourth document's function, in depths of 0 to 1.
    fn floor(self) -> f64 {
        if self == Self::Soft { 0.001 } else { -0.001 }
    }
}

impl Vsm {
    /// Whether the kernel is the calibration's fixed one rather than a number of texels.
    fn has_kernel(&self) -> bool {
        matches!(self.area, Area::Mips | Area::Table)
    }
}

impl Technique for Vsm {
    fn info(&self) -> Info {
        Info {
            title: "variance shadow map: one lookup of filtered moments",
            document: match self.area {
                Area::Texel => "T23: fourth document, variance shadow mapping",
                Area::Filtered => "T24: fourth document, antialiased and filtered VSM",
                Area::Mips => "T25: third document, introduction (mip maps)",
                Area::Table => "T25: third document, introduction (summed-area tables); Hensley et al. 2005",
            },
            options: format!("{}; {}", self.area.describe(), self.bound.describe()),
            taps: self.area.taps().to_string(),
            stochastic: false,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        match self.area {
            Area::Texel => Kernels::texels("two by two texels, weighted bilinearly"),
            Area::Filtered => Kernels::texels(
                "3x3 texels of 4x4 of the map's each, interpolated: 12x12 texels and a fringe of 2",
            ),
            Area::Mips | Area::Table => Kernels::fixed_square(calibration, self.area.cut()),
        }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let bleeding = if self.bound == Bound::Reduced { BLEEDING } else { 0.0 };
        let technique = Shade {
            uses: self.bound.fragments(),
            constants: vec![
                ("FIXED_KERNEL", f64::from(u8::from(self.has_kernel()))),
                ("BLEEDING", bleeding),
                ("VARIANCE_FLOOR", self.bound.floor()),
            ],
            ..Shade::new("vsm", OWN)
        };
        let technique = self.area.read_by(technique, recording, inputs);
        shade(recording, inputs, technique);
    }
}
