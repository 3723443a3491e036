// Slot `bias`: each tap is compared with the receiver's own plane at that tap (receiver-plane
// depth bias), less what the plane rises over the 2x2 texels of a bilinear tap.
override CONSTANT_BIAS_WORLD: f32;
// Cap of the static part: at grazing light it would swallow contact shadows.
override STATIC_BIAS_CAP_WORLD: f32;

fn reference_depth(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    let fixed = min(plane_texel_depth(s), STATIC_BIAS_CAP_WORLD);
    return plane_depth(s, offset_uv) - fixed - CONSTANT_BIAS_WORLD;
}
