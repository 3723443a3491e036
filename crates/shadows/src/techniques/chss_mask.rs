//! T12: contact hardening with a low-resolution, blurred penumbra mask.

use crate::shader::{self, Fragment};
use crate::stages::{Blur, GAUSS_7, PenumbraMask, Shade, blur, penumbra_mask, shade};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique};

const OWN: Fragment = Fragment::new("chss_mask", include_str!("chss_mask.wgsl"));

/// Blocker search at low resolution, filter at full resolution.
pub(crate) struct ChssMask {
    /// Pixels per mask texel and axis.
    pub(crate) step: u32,
    /// Point taps of the blocker search.
    pub(crate) search_taps: u32,
    /// Search radius over filter radius.
    pub(crate) search_scale: f64,
    /// Bilinear-compare taps of the filter.
    pub(crate) filter_taps: u32,
}

/// Levels that the mask stores: the demo's has 8 bits, light-matched radii keep their floats (0).
fn levels(calibration: Calibration) -> u32 {
    match calibration {
        Calibration::AsPrinted => 255,
        Calibration::LightMatched => 0,
    }
}

/// The first document's own setting.
pub(crate) const PRINTED: ChssMask =
    ChssMask { step: 4, search_taps: 32, search_scale: 1.2, filter_taps: 16 };

impl Technique for ChssMask {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening with a penumbra mask at W/4 x H/4, blurred 7x7",
            document: "T12: first document, section 2.2",
            options: String::new(),
            taps: format!(
                "{} search / {} + {} x 4",
                self.search_taps,
                self.step * self.step,
                self.filter_taps
            ),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let search = format!("{} x {}", calibration.largest_radius(), self.search_scale);
        let stored = match levels(calibration) {
            0 => "floats".into(),
            levels => format!("1/{levels} of the cap (8 bits)"),
        };
        let kernel = format!(
            "{}; without a blocker 0; found once per {step}x{step} pixels, stored in {stored}, blurred 7x7 with sigma 3, \
             fetched bilinearly",
            calibration.radius_for("the blockers' mean depth"),
            step = self.step,
        );
        Kernels::hardening(calibration, search, kernel)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let settings = PenumbraMask {
            step: self.step,
            taps: self.search_taps,
            search_scale: self.search_scale,
            levels: levels(inputs.calibration),
        };
        let mask = penumbra_mask(recording, inputs, settings);
        let labels = ["penumbra-mask-rows", "penumbra-mask-blurred"];
        let blurred = blur(recording, mask, Blur { weights: GAUSS_7, labels });
        let technique = Shade {
            uses: vec![shader::FETCH_BILINEAR, shader::FILTER_DISC, shader::KERNEL_VOGEL],
            constants: vec![
                ("MASK_STEP", f64::from(self.step)),
                ("FILTER_TAPS", f64::from(self.filter_taps)),
            ],
            reads: vec![Binding::Source(blurred)],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("chss-mask", OWN)
        };
        shade(recording, inputs, technique);
    }
}
