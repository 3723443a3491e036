//! T13: contact hardening with a minimum-filtered shadow map as the blocker's depth.

use crate::calibration::PRINTED_RADIUS_UV;
use crate::shader::{self, Fragment};
use crate::stages::{BOX_3, Blur, MinFilter, Shade, blur, min_filter, shade, shadow_map_cleared};
use crate::{Binding, Calibration, Info, Inputs, Kernels, LightMap, Recording, Technique};

const OWN: Fragment = Fragment::new("chss_min", include_str!("chss_min.wgsl"));

/// The demo reduces the map by 4 before it filters.
const SHRINK: u32 = 4;

/// Least and largest half-width of the region, in reduced texels: the demo's own, and what a pass
/// can afford.
const REGION: (u32, u32) = (2, 64);

/// Minimum of the shadow map in place of a blocker search.
pub(crate) struct ChssMin {
    /// Bilinear-compare taps of the filter.
    pub(crate) filter_taps: u32,
    /// Whether the minimum is blurred.
    pub(crate) smoothing: Smoothing,
    /// What the map holds where nothing is.
    pub(crate) empty: Empty,
}

/// Whether the minimum is blurred.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Smoothing {
    /// As it is: lumps.
    Raw,
    /// By a 3x3 box of reduced texels.
    Box,
}

/// What the map holds where nothing is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Empty {
    /// The far plane.
    Far,
    /// The demo's 1, nearer than anything: it floods the minimum (TECHNIQUES section 2). Two
    /// thousandths of the light's distance here, for the demo's light stands 500 away.
    Near,
}

/// The first document's own setting.
pub(crate) const PRINTED: ChssMin = ChssMin { filter_taps: 16, smoothing: Smoothing::Box, empty: Empty::Far };

impl Technique for ChssMin {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening with the minimum-filtered, blurred shadow map as blocker",
            document: "T13: first document, section 2.3",
            options: match (self.smoothing, self.empty) {
                (Smoothing::Raw, _) => "not blurred".into(),
                (Smoothing::Box, Empty::Far) => "blurred 3x3".into(),
                (Smoothing::Box, Empty::Near) => {
                    "blurred 3x3; the demo's map, whose empty texels are nearer than anything".into()
                }
            },
            taps: format!("1 min + {} x 4", self.filter_taps),
            stochastic: true,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        let reach = match calibration {
            Calibration::AsPrinted => calibration.largest_radius(),
            Calibration::LightMatched => {
                "the light's cone from the shadow region's centre to the nearest geometry's depth".into()
            }
        };
        let search = format!(
            "the region of the minimum: half-width ceil(r x the map's texels / {SHRINK}) reduced texels, at least {} and \
             at most {}, r = {reach}; the map is first reduced by {SHRINK}",
            REGION.0, REGION.1
        );
        let blocker = match self.smoothing {
            Smoothing::Raw => "the region's least depth, fetched bilinearly, at most z",
            Smoothing::Box => {
                "the region's least depth, blurred by a 3x3 box of reduced texels, fetched bilinearly, at most z"
            }
        };
        Kernels::hardening(calibration, search, calibration.radius_for(blocker))
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let empty = match self.empty {
            Empty::Far => f64::from(inputs.light.far),
            Empty::Near => 0.002 * f64::from(inputs.light.eye_distance),
        };
        let map = shadow_map_cleared(recording, inputs, empty);
        let radius = region_radius(inputs.calibration, inputs.light);
        let minimum = min_filter(recording, map, MinFilter { shrink: SHRINK, radius });
        let box_3 = Blur { weights: BOX_3, label: "min-map-blurred" };
        let blurred = match self.smoothing {
            Smoothing::Raw => minimum,
            Smoothing::Box => blur(recording, minimum, box_3),
        };
        let technique = Shade {
            uses: vec![shader::FETCH_BILINEAR, shader::FILTER_DISC, shader::KERNEL_VOGEL],
            constants: vec![("FILTER_TAPS", f64::from(self.filter_taps))],
            reads: vec![Binding::Source(blurred)],
            pattern: Some(shader::PATTERN_IGN),
            ..Shade::new("chss-min", OWN)
        };
        shade(recording, inputs, technique);
    }
}

/// Half-width of the region in reduced texels: "region of max penumbra size of course" (first
/// document, 2.3). The demo's is 2; light-matched, the cone from the farthest receiver that
/// matters, one at the region's centre, to the nearest blocker.
fn region_radius(calibration: Calibration, light: &LightMap) -> u32 {
    let radius_uv = match calibration {
        Calibration::AsPrinted => PRINTED_RADIUS_UV as f32,
        Calibration::LightMatched => light.true_radius_uv(light.eye_distance, light.nearest_blocker),
    };
    let texels = radius_uv * light.texels as f32 / SHRINK as f32;
    (texels.ceil() as u32).clamp(REGION.0, REGION.1)
}
