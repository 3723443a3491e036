//! T14c: contact hardening in a smaller target, upsampled.

use super::chss::CHSS;
use crate::shader::{self, Fragment};
use crate::stages::{Grid, Resolve, resolve, shade_target};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("low_res", include_str!("low_res.wgsl"));

/// What a texel's weight in the upsample depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Upsample {
    /// Its place.
    Bilinear,
    /// Its place and its surface.
    Bilateral,
}

/// A shadow for `numerator` texels on `denominator` pixels of a side.
pub(crate) struct LowRes {
    pub(crate) numerator: u32,
    pub(crate) denominator: u32,
    pub(crate) upsample: Upsample,
}

/// The size that the first document warns of.
pub(crate) const HALF: LowRes = LowRes { numerator: 1, denominator: 2, upsample: Upsample::Bilinear };

impl LowRes {
    fn scale(&self) -> String {
        format!("{}/{} of the frame's width and height", self.numerator, self.denominator)
    }

    /// In words.
    fn upsampling(&self, calibration: Calibration) -> &'static str {
        match (self.upsample, calibration) {
            (Upsample::Bilinear, _) => "fetched bilinearly",
            (_, Calibration::AsPrinted) => {
                "fetched bilinearly times 1 / (.001 + difference of depths in 1/500 of the light's distance)"
            }
            (_, Calibration::LightMatched) => {
                "fetched bilinearly times 1 / (.001 + distance from the pixel's plane / depth)"
            }
        }
    }
}

impl Technique for LowRes {
    fn info(&self) -> Info {
        let (n, d) = (self.numerator * self.numerator, self.denominator * self.denominator);
        Info {
            title: "contact hardening in a smaller target, upsampled",
            document: "T14c: first document, section 3 (comparison)",
            options: match self.upsample {
                Upsample::Bilinear => format!("{}, bilinear", self.scale()),
                Upsample::Bilateral => format!("{}, bilateral", self.scale()),
            },
            taps: format!("({} search + {} x 4) x {n}/{d}", CHSS.search_taps, CHSS.filter_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let full = CHSS.kernels(calibration);
        let kernel = format!("{}; at {}, {}", full.kernel, self.scale(), self.upsampling(calibration));
        Kernels { kernel, ..full }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let grid = Grid::Scaled { numerator: self.numerator, denominator: self.denominator };
        let coarse = shade_target(recording, inputs, grid, CHSS.shading());
        let weight = match (self.upsample, inputs.calibration) {
            (Upsample::Bilinear, _) => shader::WEIGHT_NONE,
            (_, Calibration::AsPrinted) => shader::WEIGHT_DEPTH,
            // Bilinear shares know the distance along a surface already.
            (_, Calibration::LightMatched) => shader::WEIGHT_PLANE,
        };
        let mut constants = grid.constants();
        constants.push(("DEPTH_BITS", 32.0));
        let technique = Resolve {
            label: "low-resolution",
            own: OWN,
            uses: vec![shader::TARGET_SCALED, weight],
            constants,
            reads: vec![Binding::Source(coarse)],
        };
        resolve(recording, inputs, technique);
    }
}
