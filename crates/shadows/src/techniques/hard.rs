//! T1: one comparison.

use crate::shader::Fragment;
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Lights, Projection, Recording, Technique};

const OWN: Fragment = Fragment::new("hard", include_str!("hard.wgsl"));

/// The hard shadow map.
pub(crate) struct Hard {
    /// One map, or a cube's faces.
    pub(crate) projection: Projection,
}

impl Technique for Hard {
    fn info(&self) -> Info {
        Info {
            title: "hard shadow map: one comparison with the nearest texel",
            document: "T1: second document; fourth document",
            options: String::new(),
            taps: "1".into(),
            stochastic: false,
        }
    }

    fn kernels(&self, _: Calibration) -> Kernels {
        Kernels::texels("one texel")
    }

    fn lights(&self) -> Lights {
        if self.projection == Projection::Cube { Lights::Placed } else { Lights::All }
    }

    fn projection(&self) -> Projection {
        self.projection
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        shade(recording, inputs, Shade::new("hard", OWN));
    }
}
