//! T25, T26 and T29: variance soft shadow mapping, blocker search and filter by moments.

use crate::shader::{self, Fragment};
use crate::stages::{Area, Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Projection, Recording, Technique};

const OWN: Fragment = Fragment::new("vsm_search", include_str!("vsm_search.wgsl"));

/// Half the width of a search over the largest kernel's radius: the third document's comment, "twice
/// the light size", where the light's size is the largest kernel's radius.
pub(crate) const SEARCH_SCALE: f64 = 1.0;

/// One lookup to search, one to filter.
pub(crate) struct VsmSearch {
    pub(crate) area: Area,
    /// A single map, or one with a guard band.
    pub(crate) projection: Projection,
}

impl Technique for VsmSearch {
    fn info(&self) -> Info {
        let guard = if self.projection == Projection::Guarded { "; map with a guard band" } else { "" };
        Info {
            title: "variance soft shadows: blocker search and filter by moments over squares",
            document: match (self.projection, self.area) {
                (Projection::Guarded, _) => "T26, T29: third document, shadow map bounds",
                (_, Area::Table) => "T25, T26: third document; Yang et al. 2010",
                _ => "T26: third document, average occluder depth; mip maps as filter",
            },
            options: format!("{}{guard}", self.area.describe()),
            taps: format!("{0} search + {0}", self.area.taps()),
            stochastic: false,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        Kernels::moments_square(calibration, SEARCH_SCALE, self.area.cut())
    }

    fn projection(&self) -> Projection {
        self.projection
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let technique = Shade {
            uses: vec![shader::MOMENTS_SEARCH, shader::CHEBYSHEV],
            constants: vec![("SEARCH_SCALE", SEARCH_SCALE)],
            ..Shade::new("vsm-search", OWN)
        };
        let technique = self.area.read_by(technique, recording, inputs);
        shade(recording, inputs, technique);
    }
}
