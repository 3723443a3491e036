// Slot `bias`: one constant for every tap, as the seed documents have it.
override CONSTANT_BIAS_WORLD: f32;

fn reference_depth(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    return s.depth - CONSTANT_BIAS_WORLD;
}

// The same for the four texels of a gather, in its order.
fn reference_quad(s: ShadowPoint, first: vec2<f32>, step: f32) -> vec4<f32> {
    return vec4(s.depth - CONSTANT_BIAS_WORLD);
}
