//! Kernel and bias constants of the two calibrations, in one place.

use crate::shader::{self, Fragment};
use crate::{Calibration, Inputs, LightKind, LightMap};

/// What is subtracted from every compared depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConstantBias {
    /// Metres.
    World(f64),
    /// A fraction of the light's distance from the shadow region's centre.
    PerDistance(f64),
}

/// Whether taps are compared with the receiver's plane or with its depth alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ReceiverPlane {
    /// The receiver's depth serves every tap.
    Off,
    /// The plane's depth at each texel centre.
    On {
        /// Steepest plane that is followed, metres of depth per metre across.
        max_slope: f64,
    },
}

/// The three kinds of bias.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bias {
    /// Subtracted from every compared depth.
    pub constant: ConstantBias,
    /// Receivers are moved along their normal by this many texels times the sine between normal
    /// and light.
    pub normal_offset_texels: f64,
    /// Whether taps follow the receiver's plane.
    pub receiver_plane: ReceiverPlane,
}

/// The first document's demo: largest kernel radius in map widths (TECHNIQUES section 2).
pub(crate) const PRINTED_RADIUS_UV: f64 = 0.002;

impl Calibration {
    /// The bias of this calibration.
    pub fn default_bias(self) -> Bias {
        match self {
            // The demo's constant: 2 units where the light stands 500 away.
            Self::AsPrinted => Bias {
                constant: ConstantBias::PerDistance(0.004),
                normal_offset_texels: 0.0,
                receiver_plane: ReceiverPlane::Off,
            },
            // f32 depth loses micrometres over tens of metres; 1 mm is the engines' usual constant.
            // Half a texel and 79 degrees are a compromise measured on three scenes: docs/decisions/0002.
            Self::LightMatched => Bias {
                constant: ConstantBias::World(0.001),
                normal_offset_texels: 0.5,
                receiver_plane: ReceiverPlane::On { max_slope: 5.0 },
            },
        }
    }
}

impl Bias {
    /// The constant part in metres.
    pub fn constant_world(&self, light: &LightMap) -> f64 {
        match self.constant {
            ConstantBias::World(metres) => metres,
            ConstantBias::PerDistance(fraction) => fraction * f64::from(light.eye_distance),
        }
    }

    /// What a scorecard says about it.
    pub fn describe(&self) -> String {
        let constant = match self.constant {
            ConstantBias::World(metres) => format!("constant {metres} m"),
            ConstantBias::PerDistance(fraction) => format!("constant {fraction} of the light's distance"),
        };
        let plane = match self.receiver_plane {
            ReceiverPlane::Off => "receiver plane off".to_string(),
            ReceiverPlane::On { max_slope } => {
                format!("receiver plane at texel centres, slope up to {max_slope}")
            }
        };
        format!("{constant}; normal offset {} texels; {plane}", self.normal_offset_texels)
    }
}

/// The slots that light, calibration and bias fill, with the constants they need.
pub(crate) fn slots(inputs: &Inputs<'_>) -> (Vec<Fragment>, Vec<(&'static str, f64)>) {
    let light = match inputs.light.kind {
        LightKind::Sun => shader::LIGHT_SUN,
        LightKind::Local => shader::LIGHT_LOCAL,
    };
    let law = match inputs.calibration {
        Calibration::AsPrinted => shader::LAW_SQUARED,
        Calibration::LightMatched => shader::LAW_LIGHT,
    };
    let (bias, max_slope) = match inputs.bias.receiver_plane {
        ReceiverPlane::Off => (shader::BIAS_CONSTANT, 0.0),
        ReceiverPlane::On { max_slope } => (shader::BIAS_RECEIVER_PLANE, max_slope),
    };
    let constants = vec![
        ("NORMAL_OFFSET_TEXELS", inputs.bias.normal_offset_texels),
        ("MAX_SLOPE", max_slope),
        ("CONSTANT_BIAS_WORLD", inputs.bias.constant_world(inputs.light)),
        ("FILTER_RADIUS_UV", PRINTED_RADIUS_UV),
    ];
    (vec![light, law, bias], constants)
}
