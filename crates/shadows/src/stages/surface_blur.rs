//! A blur of the penumbra mask that looks at surfaces: across like depths only (T12c), or with a
//! width that shrinks with the distance from the camera (T12d).

use super::{Blur, depth_prepass};
use crate::recording::{Binding, ComputePass, Recording, TextureId, TextureInfo};
use crate::{Inputs, shader};

/// What of a surface matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Likeness {
    /// Its depth beside that of its neighbours.
    Depth,
    /// Its distance.
    Distance,
}

/// Settings of the blur.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceBlur {
    /// Weights and the label of the result.
    pub(crate) gauss: Blur,
    /// Pixels per mask texel and axis.
    pub(crate) step: u32,
    /// What matters.
    pub(crate) likeness: Likeness,
}

/// Depths that differ by this share of themselves count .6 of like ones: a floor seen at 10 degrees
/// rises by 2 % from one mask texel to the next at 720p.
const LIKE_DEPTH: f64 = 0.05;
/// Where the scaled blur is as wide as the plain one, metres.
const PLAIN_DISTANCE_WORLD: f64 = 10.0;

/// Blurs along both axes.
pub(crate) fn surface_blur(
    recording: &mut Recording,
    inputs: &Inputs<'_>,
    (source, settings): (TextureId, SurfaceBlur),
) -> TextureId {
    let surfaces = depth_prepass(recording, inputs);
    let (fragment, entry) = match settings.likeness {
        Likeness::Depth => (shader::BLUR_DEPTH_AXIS, "blur_depth_axis"),
        Likeness::Distance => (shader::BLUR_DISTANCE_AXIS, "blur_distance_axis"),
    };
    let mut source = source;
    for (axis, label) in ["penumbra-mask-rows", settings.gauss.label].into_iter().enumerate() {
        let destination = recording.texture(TextureInfo { label, ..recording.info(source).clone() });
        let [w0, w1, w2, w3] = settings.gauss.weights;
        let pass = ComputePass {
            label,
            shader: vec![fragment.clone(), shader::GLOBALS],
            entry,
            constants: vec![
                ("AXIS", axis as f64),
                ("MASK_STEP", f64::from(settings.step)),
                ("LIKE_DEPTH", LIKE_DEPTH),
                ("PLAIN_DISTANCE_WORLD", PLAIN_DISTANCE_WORLD),
                ("WEIGHT_0", w0),
                ("WEIGHT_1", w1),
                ("WEIGHT_2", w2),
                ("WEIGHT_3", w3),
            ],
            bindings: vec![
                inputs.own_globals(),
                Binding::Source(source),
                Binding::CameraDepth(surfaces.depth),
                Binding::Destination(destination),
            ],
            groups: [0, 0],
        };
        recording.filter(pass, destination);
        source = destination;
    }
    source
}
