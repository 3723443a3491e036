//! T13: contact hardening with a minimum-filtered shadow map as the blocker's depth.

use crate::calibration::PRINTED_RADIUS_UV;
use crate::shader::{self, Fragment};
use crate::stages::{BOX_3, Blur, MinFilter, Shade, blur, min_filter, shade, shadow_map};
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
}

impl Technique for ChssMin {
    fn info(&self) -> Info {
        Info {
            title: "contact hardening with the minimum-filtered, blurred shadow map as blocker",
            document: "T13: first document, section 2.3",
            options: String::new(),
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
        let blocker =
            "the region's least depth, blurred by a 3x3 box of reduced texels, fetched bilinearly, at most z";
        Kernels::hardening(calibration, search, calibration.radius_for(blocker))
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let map = shadow_map(recording, inputs);
        let radius = region_radius(inputs.calibration, inputs.light);
        let minimum = min_filter(recording, map, MinFilter { shrink: SHRINK, radius });
        let blurred =
            blur(recording, minimum, Blur { weights: BOX_3, labels: ["min-map-rows", "min-map-blurred"] });
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
