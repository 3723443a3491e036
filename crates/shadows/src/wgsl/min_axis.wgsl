// One axis of a square minimum filter, clamped at the border.
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override AXIS: u32;
override RADIUS: i32;

@compute @workgroup_size(8, 8)
fn min_axis(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(source);
    if any(id.xy >= size) {
        return;
    }
    let step = select(vec2(0, 1), vec2(1, 0), AXIS == 0u);
    let last = vec2<i32>(size) - 1;
    var nearest_depth = 3.0e38;
    for (var k = -RADIUS; k <= RADIUS; k++) {
        let texel = clamp(vec2<i32>(id.xy) + k * step, vec2(0), last);
        nearest_depth = min(nearest_depth, textureLoad(source, texel, 0).x);
    }
    textureStore(destination, id.xy, vec4(nearest_depth, 0.0, 0.0, 0.0));
}
