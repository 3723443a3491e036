//! What a scorecard says about kernels, in the words that several techniques share.

use crate::Calibration;
use crate::calibration::{Law, PRINTED_RADIUS_UV};

/// How far a technique looks for blockers and how wide it filters, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kernels {
    /// How far blockers are sought; "none" without a search.
    pub search_radius: String,
    /// How the width of the filter comes about.
    pub kernel: String,
    /// The widest that it may become.
    pub cap: String,
    /// What "radius" means in the other three.
    pub radius_convention: String,
}

/// Of kernels on Vogel's disc; its outermost tap lies at sqrt((taps - 0.5) / taps) of the radius.
const DISC: &str = "radius of the disc in which the taps lie";

/// Of means over squares.
const SQUARE: &str = "half-side of the square that is averaged";

/// Where searches by moments find the blocker.
const MOMENTS_BLOCKER: &str = "(mean - p z) / (1 - p) of the search's moments, at least the nearest geometry's depth; \
                               lit where Chebyshev's p > 0.99";

impl Kernels {
    /// Of a filter on a disc that widens with the blocker's distance.
    pub(crate) fn hardening(calibration: Calibration, search_radius: String, kernel: String) -> Self {
        Self { search_radius, kernel, cap: calibration.largest_radius(), radius_convention: DISC.into() }
    }

    /// Of a fixed number of texels.
    pub(crate) fn texels(kernel: &str) -> Self {
        Self {
            search_radius: "none".into(),
            kernel: kernel.into(),
            cap: kernel.into(),
            radius_convention: "none: a texel is a square of the map".into(),
        }
    }

    /// Of the second document's point light, as printed, without a search.
    pub(crate) fn point_light() -> Self {
        let kernel = "a disc of the light's own radius at the receiver, square to the ray from the light";
        Self {
            search_radius: "none".into(),
            kernel: kernel.into(),
            cap: "the same everywhere".into(),
            radius_convention: DISC.into(),
        }
    }

    /// Of a mean over a square of fixed size; `cut` says what else limits it.
    pub(crate) fn fixed_square(calibration: Calibration, cut: &str) -> Self {
        let kernel = format!("square of half-side = {}{cut}", calibration.fixed_radius());
        let cap = calibration.largest_radius();
        Self { search_radius: "none".into(), kernel, cap, radius_convention: SQUARE.into() }
    }

    /// Of a blocker search and a filter by moments, both over squares.
    pub(crate) fn moments_square(calibration: Calibration, search_scale: f64, cut: &str) -> Self {
        let kernel = format!("square of half-side = {}{cut}", calibration.radius_for(MOMENTS_BLOCKER));
        Self { kernel, radius_convention: SQUARE.into(), ..Self::moments_disc(calibration, search_scale) }
    }

    /// Of a blocker search by moments and a filter on a disc.
    pub(crate) fn moments_disc(calibration: Calibration, search_scale: f64) -> Self {
        let search = format!("square of half-side = {} x {search_scale:.1}", calibration.largest_radius());
        let kernel = calibration.radius_for(MOMENTS_BLOCKER);
        Self::hardening(calibration, search, kernel)
    }

    /// Of a filter on a disc that knows no blocker.
    pub(crate) fn fixed_disc(calibration: Calibration) -> Self {
        let (kernel, cap) = (calibration.fixed_radius(), calibration.largest_radius());
        Self { search_radius: "none".into(), kernel, cap, radius_convention: DISC.into() }
    }
}

impl Calibration {
    /// The law slot's `search_radius_uv`, which no `kernel_radius_uv` exceeds.
    pub(crate) fn largest_radius(self) -> String {
        match self {
            Self::AsPrinted => format!("{PRINTED_RADIUS_UV} map widths"),
            Self::LightMatched => "the light's cone at the nearest geometry's depth".into(),
        }
    }

    /// The law slot's `kernel_radius_uv` for a receiver at depth z.
    pub(crate) fn radius_for(self, blocker: &str) -> String {
        match self {
            Self::AsPrinted => {
                format!("{PRINTED_RADIUS_UV} map widths x saturate(80 ((z - b) / b)^2), b = {blocker}")
            }
            Self::LightMatched => format!("the light's cone at depth b, b = {blocker}"),
        }
    }

    /// The law slot's `fixed_radius_uv`.
    pub(crate) fn fixed_radius(self) -> String {
        match self {
            Self::AsPrinted => self.largest_radius(),
            Self::LightMatched => "the light's cone at the scene's reference gap".into(),
        }
    }
}

impl Law {
    /// What it is, in a few words.
    pub(crate) fn describe(self) -> &'static str {
        match self {
            Self::Standard => "standard law of the calibration",
            Self::Squared => "squared law",
            Self::Linear => "linear law",
            Self::Plane => "blocker-plane law",
            Self::Distance => "distance law",
            Self::Depth01 => "linear law in depths from the near plane",
            Self::Point => "point-light law",
        }
    }

    /// The law slot's `kernel_radius_uv`, in words.
    pub(crate) fn kernel(self, calibration: Calibration, blocker: &str) -> String {
        let shape = match self {
            Self::Standard => return calibration.radius_for(blocker),
            Self::Squared if calibration == Calibration::AsPrinted => return calibration.radius_for(blocker),
            Self::Point => return format!("light's radius x (z - b) / b at the receiver, b = {blocker}"),
            Self::Squared => "((z - b) / b)^2",
            Self::Linear => "(z - b) / b",
            Self::Plane => "(z - b) / z",
            Self::Distance => "(z - b)",
            Self::Depth01 => "(z - b) / b in depths from a near plane at the nearest geometry",
        };
        let scale = match calibration {
            Calibration::AsPrinted => format!("{PRINTED_RADIUS_UV} map widths where (z - b) / b = .112"),
            Calibration::LightMatched => "the light's cone at the scene's reference gap".into(),
        };
        format!("{shape} scaled to {scale}, b = {blocker}")
    }
}
