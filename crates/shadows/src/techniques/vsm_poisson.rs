//! T26 and T27: blocker search by moments, moments averaged over Poisson taps.

use super::vsm_search::SEARCH_SCALE;
use crate::shader::{self, Fragment};
use crate::stages::{Area, Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("vsm_poisson", include_str!("vsm_poisson.wgsl"));

/// Which level the taps read, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Taps {
    /// Levels as coarse as the taps are apart.
    Matched,
    /// The map's own texels.
    Finest,
    /// As listed: all at the centre, after a search half as wide as its comment says.
    Listing,
}

/// Search by mips, turned Poisson taps.
pub(crate) struct VsmPoisson {
    pub(crate) taps: Taps,
}

/// Taps of the filter.
const FILTER_TAPS: u32 = 16;

/// Half the least distance between the first 16 points of the table, in radii of its disc.
const POISSON_RADIUS: f64 = 0.182_603_63;

impl Taps {
    fn describe(self) -> &'static str {
        match self {
            Self::Matched => "levels as coarse as the taps are apart",
            Self::Finest => "the map's own texels",
            Self::Listing => {
                "seed defects: all taps at the centre, search half as wide as its comment says, a search \
                 that finds no blocker widens the kernel"
            }
        }
    }

    fn search_scale(self) -> f64 {
        if self == Self::Listing { 0.5 * SEARCH_SCALE } else { SEARCH_SCALE }
    }
}

impl Technique for VsmPoisson {
    fn info(&self) -> Info {
        Info {
            title: "variance soft shadows: blocker search by moments, moments of turned Poisson taps",
            document: "T26, T27: third document, occluder probability",
            options: self.taps.describe().into(),
            taps: format!("{0} search + {FILTER_TAPS} x {0}", Area::Mips.taps()),
            stochastic: self.taps != Taps::Listing,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        Kernels::moments_disc(calibration, self.taps.search_scale())
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let radius = if self.taps == Taps::Finest { 0.0 } else { POISSON_RADIUS };
        let technique = Shade {
            uses: vec![shader::MOMENTS_SEARCH, shader::CHEBYSHEV, shader::KERNEL_POISSON],
            constants: vec![
                ("SEARCH_SCALE", self.taps.search_scale()),
                ("FILTER_TAPS", f64::from(FILTER_TAPS)),
                ("POISSON_RADIUS", radius),
                ("LISTING", f64::from(u8::from(self.taps == Taps::Listing))),
            ],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("vsm-poisson", OWN)
        };
        let technique = Area::Mips.read_by(technique, recording, inputs);
        shade(recording, inputs, technique);
    }
}
