//! A separable blur of up to seven point taps an axis.

use crate::recording::{Binding, ComputePass, Recording, TextureId, TextureInfo};
use crate::shader;

/// Weights at distance 0 to 3, and the labels of the two targets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blur {
    /// Weights at distance 0, 1, 2, 3; their symmetric sum is 1.
    pub(crate) weights: [f64; 4],
    /// Labels after the first and the second axis.
    pub(crate) labels: [&'static str; 2],
}

/// 7 taps, sigma 3 (first document, section 2.2; weights as printed in its demo).
pub(crate) const GAUSS_7: [f64; 4] = [0.174938, 0.165569, 0.140367, 0.106595];

/// 3 equal taps (the demo's blur of the minimum map).
pub(crate) const BOX_3: [f64; 4] = [1.0 / 3.0, 1.0 / 3.0, 0.0, 0.0];

/// Blurs along both axes.
pub(crate) fn blur(recording: &mut Recording, source: TextureId, settings: Blur) -> TextureId {
    let mut source = source;
    for (axis, label) in settings.labels.into_iter().enumerate() {
        let mut info = TextureInfo { label, ..recording.info(source).clone() };
        // Kept contents depend on the weights as well as on the source.
        let salt = settings.weights.iter().fold(1u64, |hash, w| hash.rotate_left(7) ^ w.to_bits());
        info.kept = info.kept.map(|key| key ^ salt);
        let destination = recording.texture(info);
        let [w0, w1, w2, w3] = settings.weights;
        let constants = vec![
            ("AXIS", axis as f64),
            ("WEIGHT_0", w0),
            ("WEIGHT_1", w1),
            ("WEIGHT_2", w2),
            ("WEIGHT_3", w3),
        ];
        let pass = ComputePass {
            label,
            shader: vec![shader::BLUR_AXIS],
            entry: "blur_axis",
            constants,
            bindings: vec![Binding::Source(source), Binding::Destination(destination)],
            groups: [0, 0],
        };
        recording.filter(pass, destination);
        source = destination;
    }
    source
}
