// One level from the finer one: means of 2 x 2. Slot: `destination`.
@group(0) @binding(6) var source: texture_2d<f32>;

@compute @workgroup_size(8, 8)
fn moments_halve(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(destination)) {
        return;
    }
    let first = 2u * id.xy;
    let upper = textureLoad(source, first, 0) + textureLoad(source, first + vec2(1u, 0u), 0);
    let lower = textureLoad(source, first + vec2(0u, 1u), 0) + textureLoad(source, first + 1u, 0);
    textureStore(destination, id.xy, 0.25 * (upper + lower));
}
