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

/// How wide a penumbra is for depths of receiver and blocker.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Law {
    /// As printed: listing 4 of the first document. Light-matched: the true light's cone.
    #[default]
    Standard,
    /// ((z - b) / b)^2 in both calibrations.
    Squared,
    /// (z - b) / b.
    Linear,
    /// (z - b) / z: the width at the blocker's plane.
    Plane,
    /// z - b.
    Distance,
    /// (z - b) / b in depths that count from a near plane.
    Depth01,
    /// The second document's point light.
    Point,
}

/// Ratio (z - b) / b from which listing 4's kernel no longer grows: other laws reach the same size
/// there, as printed.
const PRINTED_SATURATION: f64 = 0.111_803_398_874_989_5;

impl Law {
    /// The fragment of the shape, for laws that have one.
    fn shape(self) -> Option<Fragment> {
        match self {
            Self::Standard | Self::Point => None,
            Self::Squared => Some(shader::SHAPE_SQUARED),
            Self::Linear => Some(shader::SHAPE_LINEAR),
            Self::Plane => Some(shader::SHAPE_PLANE),
            Self::Distance => Some(shader::SHAPE_DISTANCE),
            Self::Depth01 => Some(shader::SHAPE_DEPTH01),
        }
    }

    /// The shape's value.
    fn value(self, z: f64, b: f64, near: f64) -> f64 {
        let gap = (z - b).max(0.0);
        match self {
            Self::Standard | Self::Point | Self::Linear => gap / b,
            Self::Squared => (gap / b).powi(2),
            Self::Plane => gap / z,
            Self::Distance => gap,
            Self::Depth01 => gap / (b - 0.999 * near).max(1e-6),
        }
    }

    /// Whether kernels end at the search radius: where the document says so.
    fn is_capped(self) -> bool {
        matches!(self, Self::Squared | Self::Distance)
    }

    /// Fragments and constants.
    fn fragments(self, inputs: &Inputs<'_>) -> (Vec<Fragment>, Vec<(&'static str, f64)>) {
        let printed = inputs.calibration == Calibration::AsPrinted;
        let Some(shape) = self.shape() else {
            return match (self, printed) {
                (Self::Point, true) => (vec![shader::LAW_CUBE], vec![]),
                (_, true) => (vec![shader::LAW_SQUARED], vec![("FILTER_RADIUS_UV", PRINTED_RADIUS_UV)]),
                (_, false) => (vec![shader::LAW_LIGHT], vec![]),
            };
        };
        let search = if printed { PRINTED_RADIUS_UV } else { 0.0 };
        let constants = vec![
            ("LAW_SCALE", self.scale(inputs.light, printed)),
            ("LAW_SEARCH_UV", search),
            ("LAW_CAP", if self.is_capped() { 1.0 } else { 1e9 }),
        ];
        (vec![shader::LAW_SCALED, shape], constants)
    }

    /// As printed: the demo's largest kernel where listing 4 reaches it. Light-matched: the true
    /// kernel for a receiver at the region's centre and a blocker at the reference gap.
    pub(crate) fn scale(self, light: &LightMap, printed: bool) -> f64 {
        let (z, near) = (f64::from(light.eye_distance), f64::from(light.nearest_blocker));
        if printed {
            let b = z / (1.0 + PRINTED_SATURATION);
            return PRINTED_RADIUS_UV / self.value(z, b, near);
        }
        let b = (z - f64::from(light.reference_gap)).max(near);
        f64::from(light.true_radius_uv(z as f32, b as f32)) / self.value(z, b, near).max(1e-12)
    }
}

/// The slots that light, calibration, law and bias fill, with the constants they need.
pub(crate) fn slots(inputs: &Inputs<'_>, law: Law) -> (Vec<Fragment>, Vec<(&'static str, f64)>) {
    let mut fragments = match inputs.light.kind {
        LightKind::Sun => vec![shader::LIGHT_SUN, shader::TAP],
        LightKind::Local => vec![shader::LIGHT_LOCAL, shader::TAP],
        LightKind::Cube => vec![shader::LIGHT_CUBE, shader::TAP_CUBE, shader::CUBE_FACES],
    };
    let (bias, max_slope) = match inputs.bias.receiver_plane {
        ReceiverPlane::Off => (shader::BIAS_CONSTANT, 0.0),
        ReceiverPlane::On { max_slope } => (shader::BIAS_RECEIVER_PLANE, max_slope),
    };
    let mut constants = vec![
        ("MAP_TEXELS", f64::from(inputs.light.texels)),
        ("NORMAL_OFFSET_TEXELS", inputs.bias.normal_offset_texels),
        ("MAX_SLOPE", max_slope),
        ("CONSTANT_BIAS_WORLD", inputs.bias.constant_world(inputs.light)),
    ];
    let (of_law, scaled) = law.fragments(inputs);
    fragments.extend(of_law);
    constants.extend(scaled);
    fragments.push(bias);
    (fragments, constants)
}

/// Replaces the value of a constant.
pub(crate) fn set(constants: &mut [(&'static str, f64)], (name, value): (&'static str, f64)) {
    constants.iter_mut().filter(|c| c.0 == name).for_each(|c| c.1 = value);
}
