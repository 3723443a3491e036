//! Kernel and bias constants of the two calibrations, in one place.

use crate::shader::{self, Fragment};
use crate::{Calibration, Inputs, LightKind, LightMap};

/// The first document's demo: largest kernel radius in map widths (TECHNIQUES section 2).
pub(crate) const PRINTED_RADIUS_UV: f64 = 0.002;

/// The demo's constant bias over its light's distance: 2 units at 500.
const PRINTED_BIAS_PER_DISTANCE: f64 = 0.004;

/// Light-matched: what f32 depth loses over tens of metres is micrometres; 1 mm is a surface's
/// own roughness and the engines' usual constant.
const MATCHED_BIAS_WORLD: f64 = 0.001;

/// Light-matched: cap of the static part of the receiver-plane bias.
const STATIC_BIAS_CAP_WORLD: f64 = 0.01;

/// Light-matched: steepest receiver plane that is followed, 80 degrees.
const MAX_SLOPE: f64 = 5.67;

/// The slots that light and calibration fill, with the constants they need.
pub(crate) fn slots(inputs: &Inputs<'_>) -> (Vec<Fragment>, Vec<(&'static str, f64)>) {
    let light = match inputs.light.kind {
        LightKind::Sun => shader::LIGHT_SUN,
        LightKind::Local => shader::LIGHT_LOCAL,
    };
    let (law, bias) = match inputs.calibration {
        Calibration::AsPrinted => (shader::LAW_SQUARED, shader::BIAS_CONSTANT),
        Calibration::LightMatched => (shader::LAW_LIGHT, shader::BIAS_RECEIVER_PLANE),
    };
    let constants = vec![
        ("NORMAL_OFFSET_TEXELS", 0.0),
        ("MAX_SLOPE", MAX_SLOPE),
        ("CONSTANT_BIAS_WORLD", constant_bias_world(inputs.calibration, inputs.light)),
        ("STATIC_BIAS_CAP_WORLD", STATIC_BIAS_CAP_WORLD),
        ("FILTER_RADIUS_UV", PRINTED_RADIUS_UV),
    ];
    (vec![light, law, bias], constants)
}

/// Constant depth bias in metres.
pub(crate) fn constant_bias_world(calibration: Calibration, light: &LightMap) -> f64 {
    match calibration {
        Calibration::AsPrinted => PRINTED_BIAS_PER_DISTANCE * f64::from(light.eye_distance),
        Calibration::LightMatched => MATCHED_BIAS_WORLD,
    }
}

/// What a scorecard says about the three kinds of bias.
pub(crate) fn describe_bias(calibration: Calibration) -> String {
    match calibration {
        Calibration::AsPrinted => {
            format!(
                "constant {PRINTED_BIAS_PER_DISTANCE} of the light's distance; normal offset 0; receiver plane off"
            )
        }
        Calibration::LightMatched => format!(
            "constant {MATCHED_BIAS_WORLD} m; normal offset 0; receiver plane on (slope up to {MAX_SLOPE}, static part up to \
             {STATIC_BIAS_CAP_WORLD} m)"
        ),
    }
}

/// What a scorecard says about search radius and kernel cap.
pub(crate) fn describe_kernels(calibration: Calibration) -> String {
    match calibration {
        Calibration::AsPrinted => format!(
            "kernel radius at most {PRINTED_RADIUS_UV} map widths, law saturate(80 ((z-b)/b)^2); search radius the same \
             times the search scale; radius = the disc's outermost tap circle"
        ),
        Calibration::LightMatched => "kernel radius = the light's cone at the blocker's depth; search radius = the cone at the \
             nearest geometry's depth times the search scale, which is also the cap; radius = the disc's outermost tap circle"
            .to_string(),
    }
}
