// One level of the pyramid of least and largest depth, from the level below it or from the map.
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<rg32float, write>;

// 1: the source is the shadow map, whose depth is both.
override OF_THE_MAP: u32;

@compute @workgroup_size(8, 8)
fn min_max_level(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(destination);
    if any(id.xy >= size) {
        return;
    }
    let below = textureDimensions(source);
    let first = min(2u * id.xy, below - 1u);
    // The last row and column take what an odd side leaves over.
    let last = select(min(first + 1u, below - 1u), below - 1u, id.xy == size - 1u);
    var range = vec2(3.0e38, -3.0e38);
    for (var y = first.y; y <= last.y; y++) {
        for (var x = first.x; x <= last.x; x++) {
            let texel = textureLoad(source, vec2(x, y), 0).xy;
            let pair = select(texel, texel.xx, OF_THE_MAP == 1u);
            range = vec2(min(range.x, pair.x), max(range.y, pair.y));
        }
    }
    textureStore(destination, id.xy, vec4(range, 0.0, 0.0));
}
