//! T18: contact hardening shadows, as fast hardware of 2010 had them: blocks of 8x8 texels from a
//! pyramid of the shadow map.
//!
//! "The mip level closest to a user-defined world-space kernel size": that size is the law's search
//! radius. Sharp parts read fine levels, soft parts coarse ones, so that the number of texels does
//! not depend on the map's resolution. Levels change in steps, and a step may show.

use crate::shader::{self, Fragment};
use crate::stages::{Reduction, Shade, pyramid, shade, shadow_map};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("chs", include_str!("chs.wgsl"));

/// Radius of a disc in texels that 8x8 texels hold wherever its centre lies, half a texel of a soft
/// border included.
const REACH_TEXELS: f64 = 3.5;

/// Radius of the search over the largest kernel's.
const SEARCH_SCALE: f64 = 1.0;

/// Search and filter over blocks of a pyramid.
pub(crate) struct Chs;

impl Technique for Chs {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening shadows: 8x8 texels of a fitting level for search and filter",
            document: "T18: excerpt of Real-Time Rendering (contact hardening shadows)",
            options: format!("finest level with a radius of at most {REACH_TEXELS} texels"),
            taps: "64 search + 64".into(),
            stochastic: false,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let search = format!("{} x {SEARCH_SCALE:.1}, 8x8 texels of a level", calibration.largest_radius());
        let kernel = format!(
            "{}, 8x8 texels of a level; without a blocker 0",
            calibration.radius_for("the blockers' mean depth on that level")
        );
        let convention = "radius of a disc of texels, weighted by the part inside, at least half a texel";
        Kernels { radius_convention: convention.into(), ..Kernels::hardening(calibration, search, kernel) }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let map = shadow_map(recording, inputs);
        let levels = pyramid(recording, map, (Reduction::Mean, u32::MAX));
        let technique = Shade {
            uses: vec![shader::TAP_LEVEL],
            constants: vec![("REACH_TEXELS", REACH_TEXELS), ("SEARCH_SCALE", SEARCH_SCALE)],
            reads: vec![Binding::Source(levels)],
            ..Shade::new("chs", OWN)
        };
        shade(recording, inputs, technique);
    }
}
