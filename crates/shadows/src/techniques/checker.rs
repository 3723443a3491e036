//! T14: a shadow for every second pixel, in a checkerboard; the others from their neighbours.

use super::chss::CHSS;
use super::chss_mask;
use crate::shader::{self, Fragment};
use crate::stages::{Grid, Resolve, resolve, shade_target};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("checker", include_str!("checker.wgsl"));

/// Where the kernel's radius comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Radius {
    /// A blocker search at each computed pixel.
    Search,
    /// A blurred penumbra mask at W/4 x H/4.
    Mask,
}

/// Interleaved gradient noise on the computed pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Noise {
    /// As it is.
    Plain,
    /// With y times 4, as listed.
    Tall,
}

/// How the upsample knows depths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Depths {
    /// Full floats.
    Bits32,
    /// Half floats.
    Bits16,
}

/// A checkerboard of contact-hardening shadows.
pub(crate) struct Checker {
    /// `Grid::Whole` is the control: every pixel, read as a checkerboard is.
    pub(crate) grid: Grid,
    pub(crate) radius: Radius,
    pub(crate) noise: Noise,
    pub(crate) depths: Depths,
}

/// The first document's own setting.
pub(crate) const LISTED: Checker =
    Checker { grid: Grid::Checkerboard, radius: Radius::Search, noise: Noise::Tall, depths: Depths::Bits32 };

/// Weights below whose sum a missing pixel is black: the demo's, or never.
pub(super) fn zero_below(calibration: Calibration) -> f64 {
    match calibration {
        Calibration::AsPrinted => 1.0,
        Calibration::LightMatched => 0.0,
    }
}

/// What every upsample of missing pixels says of itself.
pub(super) fn upsampling(calibration: Calibration) -> &'static str {
    match calibration {
        Calibration::AsPrinted => {
            "the other pixels from four neighbours, weighted by 1 / (.001 + difference of depths in 1/500 of the light's \
             distance), 0 where the weights sum up to less than 1"
        }
        Calibration::LightMatched => {
            "the other pixels from four neighbours, weighted by 1 / (.001 + distance of the surfaces / depth)"
        }
    }
}

impl Technique for Checker {
    fn info(&self) -> Info {
        let noise = match self.noise {
            Noise::Plain => "gradient noise as it is",
            Noise::Tall => "gradient noise with y times 4",
        };
        let depths = match self.depths {
            Depths::Bits32 => "depths in full floats",
            Depths::Bits16 => "depths of the upsample in half floats",
        };
        Info {
            title: match self.radius {
                _ if self.grid == Grid::Whole => {
                    "contact hardening at full resolution in a target: a control for those with fewer pixels"
                }
                Radius::Search => {
                    "contact hardening for every second pixel, the others from their neighbours"
                }
                Radius::Mask => {
                    "penumbra mask, filter for every second pixel, the others from their neighbours"
                }
            },
            document: match (self.noise, self.depths) {
                _ if self.grid == Grid::Whole => "T11 read as T14: no document",
                (Noise::Plain, _) => "T14 without its change of the noise: first document, section 3",
                (_, Depths::Bits16) => "T14b: first document, section 3",
                _ => "T14, T14a: first document, section 3, listing 7",
            },
            options: format!("{noise}, {depths}"),
            taps: match self.radius {
                _ if self.grid == Grid::Whole => {
                    format!("{} search + {} x 4", CHSS.search_taps, CHSS.filter_taps)
                }
                Radius::Search => format!("({} search + {} x 4) / 2", CHSS.search_taps, CHSS.filter_taps),
                Radius::Mask => format!(
                    "{} search / 16 + {} x 4 / 2",
                    chss_mask::PRINTED.search_taps,
                    chss_mask::PRINTED.filter_taps
                ),
            },
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let full = match self.radius {
            Radius::Search => CHSS.kernels(calibration),
            Radius::Mask => chss_mask::PRINTED.kernels(calibration),
        };
        if self.grid == Grid::Whole {
            return full;
        }
        Kernels { kernel: format!("{}; {}", full.kernel, upsampling(calibration)), ..full }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let mut shading = match self.radius {
            Radius::Search => CHSS.shading(),
            Radius::Mask => {
                let mask = chss_mask::PRINTED.mask(recording, inputs);
                chss_mask::PRINTED.shading(mask)
            }
        };
        if self.noise == Noise::Tall {
            shading.pattern = Some(shader::PATTERN_IGN_TALL);
        }
        let packed = shade_target(recording, inputs, self.grid, shading);
        let bits = match self.depths {
            Depths::Bits32 => 32.0,
            Depths::Bits16 => 16.0,
        };
        let mut constants = self.grid.constants();
        constants.extend([("DEPTH_BITS", bits), ("ZERO_BELOW", zero_below(inputs.calibration))]);
        let mut uses = self.grid.fragments();
        uses.extend([shader::FILL_CHECKER, inputs.calibration.weight()]);
        let technique =
            Resolve { label: "checker", own: OWN, uses, constants, reads: vec![Binding::Source(packed)] };
        resolve(recording, inputs, technique);
    }
}
