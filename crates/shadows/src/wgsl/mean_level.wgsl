// One level of the pyramid of mean depth, from the level below it or from the map: 2x2 texels each.
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

@compute @workgroup_size(8, 8)
fn mean_level(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(destination)) {
        return;
    }
    let last = textureDimensions(source) - 1u;
    let first = min(2u * id.xy, last);
    let second = min(first + 1u, last);
    let above = textureLoad(source, first, 0).x + textureLoad(source, vec2(second.x, first.y), 0).x;
    let below = textureLoad(source, vec2(first.x, second.y), 0).x + textureLoad(source, second, 0).x;
    textureStore(destination, id.xy, vec4(0.25 * (above + below), 0.0, 0.0, 0.0));
}
