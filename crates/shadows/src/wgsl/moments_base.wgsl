// The finest level of a prefiltered shadow map. Slots: `moments_of` (what of a depth is averaged)
// and `destination`. Texels beyond the map, which fill it up to a power of two, repeat its border:
// then every texel of every level is the mean of a whole block of the map.
@group(0) @binding(6) var source: texture_2d<f32>;

@compute @workgroup_size(8, 8)
fn moments_base(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(destination)) {
        return;
    }
    let texel = min(id.xy, textureDimensions(source) - 1u);
    textureStore(destination, id.xy, moments_of(textureLoad(source, texel, 0).x));
}
