// The nearest depth of each SHRINK x SHRINK block.
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override SHRINK: u32;

@compute @workgroup_size(8, 8)
fn min_shrink(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(source);
    let first = id.xy * SHRINK;
    if any(first >= size) {
        return;
    }
    var nearest_depth = 3.0e38;
    for (var k = 0u; k < SHRINK * SHRINK; k++) {
        let texel = min(first + vec2(k % SHRINK, k / SHRINK), size - 1u);
        nearest_depth = min(nearest_depth, textureLoad(source, texel, 0).x);
    }
    textureStore(destination, id.xy, vec4(nearest_depth, 0.0, 0.0, 0.0));
}
