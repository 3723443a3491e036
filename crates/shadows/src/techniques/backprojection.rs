//! T21: backprojection. Each texel nearer to the light than the receiver is a patch that hides a part
//! of the light's disc: what one layer of the map knows, with no mean of blockers.
//!
//! A square patch at the depth of its texel leaves gaps between texels of different depths, through
//! which light leaks, and overlaps others: a sum of areas counts the overlap twice, bits do not.
//! Local lights' discs are those of equal area that stand parallel to the map.

use crate::shader::{self, Fragment};
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const AREAS: Fragment = Fragment::new("backprojection", include_str!("backprojection.wgsl"));
const BITS: Fragment = Fragment::new("backprojection_bits", include_str!("backprojection_bits.wgsl"));

/// Cells a side: wider regions get cells of more than one texel, each with its middle texel's depth.
const SEARCH_CELLS: u32 = 16;

/// How what the patches hide is added up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Hidden {
    /// By area, at most all of the disc.
    Areas,
    /// By places on the disc.
    Bits,
}

/// The light's disc behind the texels of the map.
pub(crate) struct Backprojection {
    /// How it is added up.
    pub(crate) hidden: Hidden,
}

impl Technique for Backprojection {
    fn info(&self) -> Info {
        Info {
            title: match self.hidden {
                Hidden::Areas => "backprojection: the sum of the light's parts that texels hide",
                Hidden::Bits => "backprojection: 64 places on the light, each hidden by texels or not",
            },
            document: match self.hidden {
                Hidden::Areas => "T21: excerpt of Real-Time Rendering; Guennebaud et al. 2006",
                Hidden::Bits => "T21: excerpt of Real-Time Rendering; Schwarz and Stamminger 2007",
            },
            options: format!("at most {SEARCH_CELLS}x{SEARCH_CELLS} cells"),
            taps: format!("{SEARCH_CELLS} x {SEARCH_CELLS}"),
            stochastic: false,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let search = format!(
            "{}; every texel, or at most {SEARCH_CELLS} a side with more than one texel between",
            calibration.largest_radius()
        );
        let kernel = format!(
            "{}: the light's disc as seen through a texel",
            calibration.radius_for("the texel's depth")
        );
        let convention =
            "radius of the disc of the map that stands for the light, of which texels' squares hide parts";
        Kernels { radius_convention: convention.into(), ..Kernels::hardening(calibration, search, kernel) }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let (own, label, uses) = match self.hidden {
            Hidden::Areas => (AREAS, "backprojection", vec![shader::LIGHT_PATCHES]),
            Hidden::Bits => (BITS, "backprojection-bits", vec![shader::LIGHT_PATCHES, shader::KERNEL_VOGEL]),
        };
        let constants = vec![("SEARCH_CELLS", f64::from(SEARCH_CELLS))];
        shade(recording, inputs, Shade { uses, constants, ..Shade::new(label, own) });
    }
}
