//! The shadow map's deeper layers, by depth peeling (T22): each holds the nearest surface behind the
//! layer before it, at every texel. Two layers of a solid are its front and its back.

use super::shadow_map;
use crate::recording::{Binding, Format, Pass, RasterPass, Recording, TextureId, TextureInfo};
use crate::{Inputs, shader};

/// The layers behind the map itself.
const LABELS: [&str; 3] = ["shadow-layer-2", "shadow-layer-3", "shadow-layer-4"];

/// The layers behind the map, `layers - 1` of them and at most three; kept as the map is.
pub(crate) fn deeper_layers(recording: &mut Recording, inputs: &Inputs<'_>, layers: u32) -> Vec<TextureId> {
    let mut before = shadow_map(recording, inputs);
    let labels = LABELS.into_iter().take(layers.saturating_sub(1) as usize);
    let peeled = labels.map(|label| {
        before = peel(recording, inputs, (before, label));
        before
    });
    peeled.collect()
}

/// The nearest surface behind a layer; the far plane where there is none.
fn peel(
    recording: &mut Recording,
    inputs: &Inputs<'_>,
    (before, label): (TextureId, &'static str),
) -> TextureId {
    let info = TextureInfo { label, ..recording.info(before).clone() };
    let buffer = TextureInfo { format: Format::Depth32Float, kept: None, ..info.clone() };
    let layer = recording.texture(info);
    let depth = recording.find("shadow-depth-buffer").unwrap_or_else(|| recording.texture(buffer));
    recording.passes.push(Pass::Raster(RasterPass {
        label,
        shader: vec![shader::RASTER_PEEL, shader::GLOBALS],
        cut: inputs.cut(shader::RASTER_PEEL_CUT, &[]),
        constants: vec![],
        bindings: vec![Binding::Globals, Binding::Source(before)],
        targets: vec![(layer, f64::from(inputs.light.far))],
        depth,
        viewport: None,
    }));
    layer
}
