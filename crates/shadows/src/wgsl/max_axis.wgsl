// One axis of a square maximum filter of seven texels, clamped at the border (T12e).
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override AXIS: u32;

@compute @workgroup_size(8, 8)
fn max_axis(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(source);
    if any(id.xy >= size) {
        return;
    }
    let step = select(vec2(0, 1), vec2(1, 0), AXIS == 0u);
    let last = vec2<i32>(size) - 1;
    var largest = 0.0;
    for (var k = -3; k <= 3; k++) {
        let texel = clamp(vec2<i32>(id.xy) + k * step, vec2(0), last);
        largest = max(largest, textureLoad(source, texel, 0).x);
    }
    textureStore(destination, id.xy, vec4(largest, 0.0, 0.0, 0.0));
}
