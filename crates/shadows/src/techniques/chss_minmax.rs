//! T19: contact hardening that a pyramid of least and largest depth spares where it can: the picture
//! is that of `chss`, bit for bit.

use super::chss;
use crate::shader::{self, Fragment};
use crate::stages::{Reduction, Shade, pyramid, shade, shadow_map};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("chss_minmax", include_str!("chss_minmax.wgsl"));
const FETCHES: Fragment = Fragment::new("chss_minmax_fetches", include_str!("chss_minmax_fetches.wgsl"));

/// Texels of the pyramid along a side of the square that a receiver asks about: two, as finer levels
/// would need more fetches.
const BOUNDS_SIDE: u32 = 2;

/// What comes out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Output {
    /// The shadow.
    Shadow,
    /// The share of `chss`'s fetches that are still made (claim C35); a gather is one.
    Fetches,
}

/// `chss` with early-outs by bounds of the map's depths.
pub(crate) struct ChssMinmax {
    /// What comes out.
    pub(crate) output: Output,
}

impl Technique for ChssMinmax {
    fn info(&self) -> Info {
        Info {
            title: match self.output {
                Output::Shadow => "contact hardening with early-outs by a min/max pyramid of the map",
                Output::Fetches => "share of chss's fetches that chss-minmax still makes",
            },
            document: "T19: excerpt of Real-Time Rendering (hierarchical min/max shadow map)",
            options: format!("{BOUNDS_SIDE}x{BOUNDS_SIDE} texels of the pyramid"),
            taps: format!("{} bounds, then {}", BOUNDS_SIDE * BOUNDS_SIDE, chss::CHSS.info().taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        chss::CHSS.kernels(calibration)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let map = shadow_map(recording, inputs);
        let bounds = pyramid(recording, map, (Reduction::MinMax, u32::MAX));
        let own = match self.output {
            Output::Shadow => OWN,
            Output::Fetches => FETCHES,
        };
        let mut constants = chss::CHSS.constants();
        constants.push(("BOUNDS_SIDE", f64::from(BOUNDS_SIDE)));
        let technique = Shade {
            uses: [chss::uses(), vec![shader::EARLY_BOUNDS, shader::MAP_BOUNDS]].concat(),
            constants,
            reads: vec![Binding::Source(bounds)],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("chss-minmax", own)
        };
        shade(recording, inputs, technique);
    }
}
