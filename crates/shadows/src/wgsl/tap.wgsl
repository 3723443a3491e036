// Reading the shadow map. Outside it everything is lit.
@group(0) @binding(1) var shadow_map: texture_2d<f32>;
@group(0) @binding(8) var nearest: sampler;

fn inside_map(uv: vec2<f32>) -> bool {
    return all(uv >= vec2(0.0)) && all(uv < vec2(1.0));
}

// Depth of the texel that holds this place; far away outside the map.
fn map_depth(uv: vec2<f32>) -> f32 {
    if !inside_map(uv) {
        return 3.0e38;
    }
    return textureLoad(shadow_map, vec2<u32>(uv * f32(globals.map_size)), 0).x;
}

fn lit_nearest(uv: vec2<f32>, reference: f32) -> f32 {
    return select(0.0, 1.0, reference <= map_depth(uv));
}

// Four compares, bilinearly weighted in full precision: samplers that do this keep 8 bits of the
// weights, differently on each adapter.
fn lit_bilinear(uv: vec2<f32>, reference: f32) -> f32 {
    if !inside_map(uv) {
        return 1.0;
    }
    let place = uv * f32(globals.map_size) - 0.5;
    let base = floor(place);
    let weight = place - base;
    // Gathered from the corner that the four texels share: a driver's own rounding of `uv` could
    // pick a neighbouring footprint.
    let depths = textureGather(0, shadow_map, nearest, (base + 1.0) / f32(globals.map_size));
    let lit = select(vec4(0.0), vec4(1.0), vec4(reference) <= depths);
    return mix(mix(lit.w, lit.z, weight.x), mix(lit.x, lit.y, weight.x), weight.y);
}
