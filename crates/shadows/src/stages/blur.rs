//! A separable blur of up to seven point taps an axis, in one pass.

use crate::recording::{Binding, ComputePass, Recording, TextureId, TextureInfo};
use crate::shader;

/// Weights at distance 0 to 3, and the label of the target.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blur {
    /// Weights at distance 0, 1, 2, 3; their symmetric sum is 1.
    pub(crate) weights: [f64; 4],
    /// Label of pass and target.
    pub(crate) label: &'static str,
}

/// 7 taps, sigma 3 (first document, section 2.2; weights as printed in its demo).
pub(crate) const GAUSS_7: [f64; 4] = [0.174938, 0.165569, 0.140367, 0.106595];

/// 3 equal taps (the demo's blur of the minimum map).
pub(crate) const BOX_3: [f64; 4] = [1.0 / 3.0, 1.0 / 3.0, 0.0, 0.0];

/// Blurs along both axes.
pub(crate) fn blur(recording: &mut Recording, source: TextureId, settings: Blur) -> TextureId {
    let Blur { weights, label } = settings;
    let mut info = TextureInfo { label, ..recording.info(source).clone() };
    // Kept contents depend on the weights as well as on the source.
    let salt = weights.iter().fold(1u64, |hash, w| hash.rotate_left(7) ^ w.to_bits());
    info.kept = info.kept.map(|key| key ^ salt);
    let destination = recording.texture(info);
    let [w0, w1, w2, w3] = weights;
    let pass = ComputePass {
        label,
        shader: vec![shader::BLUR_TILE],
        entry: "blur_tile",
        constants: vec![("WEIGHT_0", w0), ("WEIGHT_1", w1), ("WEIGHT_2", w2), ("WEIGHT_3", w3)],
        bindings: vec![Binding::Source(source), Binding::Destination(destination)],
        groups: [0, 0],
    };
    recording.filter(pass, destination);
    destination
}
