// Slot `bias`: each texel is compared with the receiver's own plane there (receiver-plane depth
// bias, taken at texel centres, so that no static part is needed).
override CONSTANT_BIAS_WORLD: f32;

fn reference_depth(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    return plane_depth(s, offset_uv) - CONSTANT_BIAS_WORLD;
}
