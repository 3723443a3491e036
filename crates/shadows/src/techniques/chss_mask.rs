//! T12: contact hardening with a low-resolution penumbra mask, and every option of the document.

use crate::shader::{self, Fragment};
use crate::stages::{
    Blur, GAUSS_7, Likeness, PenumbraMask, Shade, SurfaceBlur, blur, max_filter, min_shrink, penumbra_mask,
    shade, shadow_map, surface_blur,
};
use crate::{Binding, Calibration, Info, Inputs, Kernels, Recording, Technique, TextureId};

const OWN: Fragment = Fragment::new("chss_mask", include_str!("chss_mask.wgsl"));

/// Blocker search at low resolution, filter at full resolution.
pub(crate) struct ChssMask {
    /// Pixels per mask texel and axis.
    pub(crate) step: u32,
    /// Point taps of the blocker search.
    pub(crate) search_taps: u32,
    /// Search radius over filter radius (T12a).
    pub(crate) search_scale: f64,
    /// Bilinear-compare taps of the filter.
    pub(crate) filter_taps: u32,
    /// What happens to the mask before it is used.
    pub(crate) smoothing: Smoothing,
    /// What the mask holds where nothing blocks.
    pub(crate) without_blocker: WithoutBlocker,
    /// Which map is searched.
    pub(crate) searched: Searched,
    /// Whether narrow kernels take fewer taps (T11e).
    pub(crate) taps: TapCount,
}

/// How many taps a kernel takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TapCount {
    /// All, whatever its width.
    All,
    /// One below half a texel, where the bilinear compare is as wide; a quarter of them below one
    /// texel, half below two: the taps' texels then still overlap.
    ByWidth,
}

/// What happens to the mask before it is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Smoothing {
    /// Nothing.
    Raw,
    /// T12b: a Gaussian of 7x7 texels.
    Gauss,
    /// T12c: the same, across surfaces of like depth only.
    DepthAware,
    /// T12d: the same, its width inversely proportional to the distance from the camera.
    DistanceScaled,
    /// T12e: the largest of 7x7 texels first, then the Gaussian.
    MaxFirst,
}

/// T12f: what the mask holds where nothing blocks, as a share of the largest radius.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WithoutBlocker {
    /// 0.
    Nothing,
    /// 1.
    Largest,
}

/// Which map is searched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Searched {
    /// The shadow map.
    Full,
    /// The nearest depth of each 2x2 texels of it, as the demo can.
    Halved,
}

/// The document's blur.
pub(super) const BLUR: Blur = Blur { weights: GAUSS_7, label: "penumbra-mask-blurred" };

/// Levels that the mask stores: the demo's has 8 bits, light-matched radii keep their floats (0).
pub(super) fn levels(calibration: Calibration) -> u32 {
    match calibration {
        Calibration::AsPrinted => 255,
        Calibration::LightMatched => 0,
    }
}

/// The first document's own setting.
pub(crate) const PRINTED: ChssMask = ChssMask {
    step: 4,
    search_taps: 32,
    search_scale: 1.2,
    filter_taps: 16,
    smoothing: Smoothing::Gauss,
    without_blocker: WithoutBlocker::Nothing,
    searched: Searched::Full,
    taps: TapCount::All,
};

impl Smoothing {
    fn describe(self) -> &'static str {
        match self {
            Self::Raw => "not blurred",
            Self::Gauss => "blurred 7x7 with sigma 3",
            Self::DepthAware => "blurred 7x7 with sigma 3 across like depths",
            Self::DistanceScaled => {
                "blurred with sigma 3 texels at 10 m, inversely proportional to the distance"
            }
            Self::MaxFirst => "the largest of 7x7, then blurred 7x7 with sigma 3",
        }
    }
}

impl ChssMask {
    /// The mask, smoothed.
    pub(crate) fn mask(&self, recording: &mut Recording, inputs: &Inputs<'_>) -> TextureId {
        let map = shadow_map(recording, inputs);
        let map = match self.searched {
            Searched::Full => map,
            Searched::Halved => min_shrink(recording, map, 2),
        };
        let settings = PenumbraMask {
            step: self.step,
            taps: self.search_taps,
            search_scale: self.search_scale,
            levels: levels(inputs.calibration),
            without_blocker: f64::from(u8::from(self.without_blocker == WithoutBlocker::Largest)),
        };
        let mask = penumbra_mask(recording, inputs, (settings, map));
        let surfaces = |likeness| SurfaceBlur { gauss: BLUR, step: self.step, likeness };
        match self.smoothing {
            Smoothing::Raw => mask,
            Smoothing::Gauss => blur(recording, mask, BLUR),
            Smoothing::DepthAware => surface_blur(recording, inputs, (mask, surfaces(Likeness::Depth))),
            Smoothing::DistanceScaled => {
                surface_blur(recording, inputs, (mask, surfaces(Likeness::Distance)))
            }
            Smoothing::MaxFirst => {
                let largest = max_filter(recording, mask);
                blur(recording, largest, BLUR)
            }
        }
    }

    /// The filter, wherever it is run.
    pub(super) fn shading(&self, mask: TextureId) -> Shade {
        Shade {
            uses: vec![shader::FETCH_BILINEAR, shader::FILTER_DISC, shader::KERNEL_VOGEL],
            constants: vec![
                ("MASK_STEP", f64::from(self.step)),
                ("FILTER_TAPS", f64::from(self.filter_taps)),
                ("FEW_TEXELS", if self.taps == TapCount::ByWidth { 2.0 } else { 0.0 }),
            ],
            reads: vec![Binding::Source(mask)],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("chss-mask", OWN)
        }
    }
}

impl Technique for ChssMask {
    fn info(&self) -> Info {
        let default = match self.without_blocker {
            WithoutBlocker::Nothing => "0 without a blocker",
            WithoutBlocker::Largest => "the largest radius without a blocker",
        };
        let map = match self.searched {
            Searched::Full => "",
            Searched::Halved => ", search in the map of 2x2 minima",
        };
        Info {
            title: "contact hardening with a penumbra mask at W/4 x H/4",
            document: "T12: first document, section 2.2",
            options: format!("search x {}, {}, {default}{map}", self.search_scale, self.smoothing.describe()),
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
        let default = match self.without_blocker {
            WithoutBlocker::Nothing => "0",
            WithoutBlocker::Largest => "the cap",
        };
        let kernel = format!(
            "{}; without a blocker {default}; found once per {step}x{step} pixels, stored in {stored}, {}, fetched \
             bilinearly",
            calibration.radius_for("the blockers' mean depth"),
            self.smoothing.describe(),
            step = self.step,
        );
        Kernels::hardening(calibration, search, kernel)
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let mask = self.mask(recording, inputs);
        shade(recording, inputs, self.shading(mask));
    }
}
