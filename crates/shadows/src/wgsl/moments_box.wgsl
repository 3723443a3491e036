// The mean of 3 x 3 texels of one level, clamped at the border (fourth seed document). Slot:
// `destination`.
@group(0) @binding(6) var source: texture_2d<f32>;

@compute @workgroup_size(8, 8)
fn moments_box(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(source);
    if any(id.xy >= size) {
        return;
    }
    let last = vec2<i32>(size) - 1;
    var sum = vec4(0.0);
    for (var k = 0; k < 9; k++) {
        let texel = vec2<i32>(id.xy) + vec2(k % 3, k / 3) - 1;
        sum += textureLoad(source, clamp(texel, vec2(0), last), 0);
    }
    textureStore(destination, id.xy, sum / 9.0);
}
