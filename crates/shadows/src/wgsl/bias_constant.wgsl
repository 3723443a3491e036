// Slot `bias`: one constant for every tap, as the seed documents have it.
override CONSTANT_BIAS_WORLD: f32;

fn reference_depth(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    return s.depth - CONSTANT_BIAS_WORLD;
}
