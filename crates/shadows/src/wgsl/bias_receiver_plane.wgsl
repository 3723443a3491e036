// Slot `bias`: each texel is compared with the receiver's own plane there (receiver-plane depth
// bias, taken at texel centres, so that no static part is needed).
override CONSTANT_BIAS_WORLD: f32;

fn reference_depth(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    return plane_depth(s, offset_uv) - CONSTANT_BIAS_WORLD;
}

// The same for the four texels of a gather, in its order; `first` is its last.
fn reference_quad(s: ShadowPoint, first: vec2<f32>, step: f32) -> vec4<f32> {
    return plane_quad(s, first, step) - CONSTANT_BIAS_WORLD;
}
