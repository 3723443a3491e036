//! T3: comparisons on a square grid of texels.

use super::pcf_disc::Tap;
use crate::shader::Fragment;
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("pcf_grid", include_str!("pcf_grid.wgsl"));

/// Percentage-closer filtering on a grid.
pub(crate) struct PcfGrid {
    /// Taps per side.
    pub(crate) side: u32,
    /// What each compares.
    pub(crate) tap: Tap,
}

impl Technique for PcfGrid {
    fn info(&self) -> Info {
        Info {
            title: "PCF: the mean of comparisons on a square grid of fixed size",
            document: match self.tap {
                Tap::Point => "T3: first document, figure 2; second and fourth document",
                Tap::Bilinear => "T4: fourth document, PCF and interpolation",
            },
            options: match self.tap {
                Tap::Point => format!("{0} x {0} points", self.side),
                Tap::Bilinear => format!("{0} x {0} interpolated comparisons", self.side),
            },
            taps: self.tap.count(self.side * self.side),
            stochastic: false,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let kernel = match calibration {
            Calibration::AsPrinted => {
                format!("{0}x{0} texels of the map, side {1} texels", self.side, self.side - 1)
            }
            Calibration::LightMatched => {
                format!("square of half-side = {}", calibration.fixed_radius())
            }
        };
        let cap = match calibration {
            Calibration::AsPrinted => "the same everywhere".into(),
            Calibration::LightMatched => calibration.largest_radius(),
        };
        Kernels {
            search_radius: "none".into(),
            kernel,
            cap,
            radius_convention: "half-side of the square on whose border the outermost taps lie".into(),
        }
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let step_texels = match inputs.calibration {
            Calibration::AsPrinted => 1.0,
            Calibration::LightMatched => 0.0,
        };
        let constants = vec![
            ("GRID_SIDE", f64::from(self.side)),
            ("GRID_STEP_TEXELS", step_texels),
            ("GRID_BILINEAR", f64::from(u8::from(self.tap == Tap::Bilinear))),
        ];
        shade(recording, inputs, Shade { constants, ..Shade::new("pcf-grid", OWN) });
    }
}
