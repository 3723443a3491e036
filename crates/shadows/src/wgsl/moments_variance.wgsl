// Slots `moments_of` and `destination` of variance shadow maps: depth and its square.
@group(0) @binding(7) var destination: texture_storage_2d<rg32float, write>;

fn moments_of(depth: f32) -> vec4<f32> {
    let u = moment_depth(depth);
    return vec4(u, u * u, 0.0, 0.0);
}
