// Slots `moments_of` and `destination` of exponential shadow maps: relative to the far plane, so that
// no depth overflows.
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

// Exponent per metre of depth.
override ESM_SHARPNESS: f32;

fn moments_of(depth: f32) -> vec4<f32> {
    return vec4(exp(ESM_SHARPNESS * (depth - globals.far)), 0.0, 0.0, 0.0);
}
