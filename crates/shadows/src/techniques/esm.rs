//! T30: exponential shadow maps with a fixed kernel.

use crate::shader::{self, Fragment};
use crate::stages::{Content, Levels, Shade, moments, shade};
use crate::{Binding, Calibration, Info, Inputs, Kernels, LightMap, Recording, Technique};

const OWN: Fragment = Fragment::new("esm", include_str!("esm.wgsl"));

/// The prefiltered exponential of the shadow map.
pub(crate) struct Esm;

/// Exponent over the whole range of depths (Annen et al. 2008): e^-80 is still a normal f32.
const EXPONENT: f64 = 80.0;

/// Exponent per metre. As printed: over depths from the light to the far plane. Light-matched: over
/// the depths that there are, which separates surfaces better.
fn sharpness(calibration: Calibration, light: &LightMap) -> f64 {
    let nearest = match calibration {
        Calibration::AsPrinted => 0.0,
        Calibration::LightMatched => light.nearest_blocker,
    };
    EXPONENT / f64::from(light.far - nearest).max(1e-6)
}

impl Technique for Esm {
    fn info(&self) -> Info {
        Info {
            title: "exponential shadow map: one lookup of the filtered exponential",
            document: "T30: first document, comparison (named only); Annen et al. 2008",
            options: format!(
                "exponent {EXPONENT} over the range of depths; {}",
                crate::stages::Area::Mips.describe()
            ),
            taps: "8".into(),
            stochastic: false,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        Kernels::fixed_square(calibration, "")
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let per_metre = sharpness(inputs.calibration, inputs.light);
        let chain = moments(recording, inputs, (Content::Exponential { per_metre }, Levels::All));
        let technique = Shade {
            uses: vec![shader::MOMENTS_MIPS],
            constants: vec![("MOMENTS_STEP", 1.0), ("ESM_SHARPNESS", per_metre)],
            reads: vec![Binding::Source(chain)],
            ..Shade::new("esm", OWN)
        };
        shade(recording, inputs, technique);
    }
}
