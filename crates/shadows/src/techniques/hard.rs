//! T1: one comparison.

use crate::shader::Fragment;
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("hard", include_str!("hard.wgsl"));

/// The hard shadow map.
pub(crate) struct Hard;

impl Technique for Hard {
    fn info(&self) -> Info {
        Info {
            title: "hard shadow map: one comparison with the nearest texel",
            document: "T1: second document; fourth document",
            taps: "1".into(),
            stochastic: false,
        }
    }

    fn kernels(&self, _: Calibration) -> Kernels {
        Kernels {
            search_radius: "none".into(),
            kernel: "one texel".into(),
            cap: "one texel".into(),
            radius_convention: "none: a texel is a square of the map".into(),
        }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let technique = Shade { label: "hard", own: OWN, uses: vec![], constants: vec![], source: None };
        shade(recording, inputs, technique);
    }
}
