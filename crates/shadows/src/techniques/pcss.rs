//! T11b as the second document has it: percentage-closer soft shadows with Poisson taps, for a
//! direction, a perspective map or a cube map, and the ways in which its text and code differ.

use super::pcf_disc::{Points, Rotation, Tap};
use crate::calibration::Law;
use crate::shader::Fragment;
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Lights, Projection, Recording, Technique};

const OWN: Fragment = Fragment::new("pcss", include_str!("pcss.wgsl"));

/// The document leaves both counts to the reader; these are those that the first document quotes
/// for common practice (16 to find blockers, 32 to filter).
const SEARCH_TAPS: u32 = 16;
const FILTER_TAPS: u32 = 32;

/// Whose depths are averaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mean {
    /// The blockers', as the code does.
    Blockers,
    /// All taps', as the text says.
    All,
}

/// Percentage-closer soft shadows.
pub(crate) struct Pcss {
    pub(crate) law: Law,
    pub(crate) mean: Mean,
    pub(crate) projection: Projection,
}

/// The document's code, with depths in metres.
pub(crate) const MENDED: Pcss =
    Pcss { law: Law::Standard, mean: Mean::Blockers, projection: Projection::Single };

impl Pcss {
    /// The document's own law as printed is the linear one; light-matched it is the true light's cone.
    fn law_in(&self, calibration: Calibration) -> Law {
        match (self.law, calibration) {
            (Law::Standard, Calibration::AsPrinted) => Law::Linear,
            (law, _) => law,
        }
    }
}

impl Technique for Pcss {
    fn info(&self) -> Info {
        Info {
            title: "percentage-closer soft shadows: Poisson taps turned by a hash of the world position",
            document: "T11b: second document, section 2",
            options: match (self.projection, self.law, self.mean) {
                (Projection::Cube, ..) => "cube map, search 1.5 x the light's angle as printed".into(),
                (_, Law::Depth01, _) => "seed defect: depths count from the near plane".into(),
                (.., Mean::All) => "seed defect: the mean of all taps, as its text says".into(),
                _ => "depths in metres, mean of the blockers".into(),
            },
            taps: format!("{SEARCH_TAPS} search + {FILTER_TAPS}"),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let mean = match self.mean {
            Mean::Blockers => "the blockers' mean depth",
            Mean::All => "the mean depth of all taps",
        };
        if self.law == Law::Point && calibration == Calibration::AsPrinted {
            let search = "1.5 x the light's radius over the receiver's distance".into();
            let kernel = format!("{}; without a blocker lit", self.law.kernel(calibration, mean));
            return Kernels { cap: "none".into(), ..Kernels::hardening(calibration, search, kernel) };
        }
        let search = format!("{} x 1.0", calibration.largest_radius());
        let law = if self.law == Law::Point { Law::Standard } else { self.law_in(calibration) };
        let kernel = format!("{}; without a blocker lit", law.kernel(calibration, mean));
        Kernels::hardening(calibration, search, kernel)
    }

    fn lights(&self) -> Lights {
        match (self.projection, self.law) {
            (Projection::Cube, _) => Lights::Placed,
            // The document's near plane belongs to an orthographic map.
            (_, Law::Depth01) => Lights::Suns,
            _ => Lights::All,
        }
    }

    fn projection(&self) -> Projection {
        self.projection
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let technique = Shade {
            uses: vec![Tap::Point.fragment(), Points::Poisson.fragment(FILTER_TAPS)],
            constants: vec![
                ("SEARCH_TAPS", f64::from(SEARCH_TAPS)),
                ("SEARCH_SCALE", 1.0),
                ("FILTER_TAPS", f64::from(FILTER_TAPS)),
                ("MEAN_OF_ALL", f64::from(u8::from(self.mean == Mean::All))),
            ],
            law: self.law_in(inputs.calibration),
            pattern: Some(Rotation::World.fragment()),
            ..Shade::new("pcss", OWN)
        };
        shade(recording, inputs, technique);
    }
}
