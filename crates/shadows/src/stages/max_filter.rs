//! The largest of 7x7 texels of the penumbra mask (T12e).

use crate::recording::{Binding, ComputePass, Recording, TextureId, TextureInfo};
use crate::shader;

/// Filters along both axes.
pub(crate) fn max_filter(recording: &mut Recording, source: TextureId) -> TextureId {
    let mut source = source;
    for (axis, label) in ["penumbra-mask-max-rows", "penumbra-mask-max"].into_iter().enumerate() {
        let destination = recording.texture(TextureInfo { label, ..recording.info(source).clone() });
        let pass = ComputePass {
            label,
            shader: vec![shader::MAX_AXIS],
            entry: "max_axis",
            constants: vec![("AXIS", axis as f64)],
            bindings: vec![Binding::Source(source), Binding::Destination(destination)],
            groups: [0, 0],
        };
        recording.filter(pass, destination);
        source = destination;
    }
    source
}
