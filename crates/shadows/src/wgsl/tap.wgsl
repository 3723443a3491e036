// Reading and comparing the shadow map. Outside it everything is lit. References are taken at
// texel centres, where the map holds exact depths: a plane never shadows itself then.
@group(0) @binding(1) var shadow_map: texture_2d<f32>;
@group(0) @binding(8) var nearest: sampler;

// Texels of the map's side: that of the light, or of a map reduced from it.
override MAP_TEXELS: f32;

fn inside_map(uv: vec2<f32>) -> bool {
    return all(uv >= vec2(0.0)) && all(uv < vec2(1.0));
}

// The nearest texel's depth (far away outside the map), and the receiver's reference there. Without
// a branch: the fetches of a loop then go out together.
fn nearest_pair(s: ShadowPoint, offset_uv: vec2<f32>) -> vec2<f32> {
    let uv = s.uv + offset_uv;
    let texel = floor(uv * MAP_TEXELS);
    let inside = clamp(texel, vec2(0.0), vec2(MAP_TEXELS - 1.0));
    let depth = textureLoad(shadow_map, vec2<u32>(inside), 0).x;
    let pair = vec2(depth, reference_depth(s, (texel + 0.5) / MAP_TEXELS - s.uv));
    return select(vec2(3.0e38, 0.0), pair, inside_map(uv));
}

fn lit_nearest(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    let pair = nearest_pair(s, offset_uv);
    return select(0.0, 1.0, pair.y <= pair.x);
}

// Four compares, bilinearly weighted in full precision: samplers that do this keep 8 bits of the
// weights, differently on each adapter.
fn lit_bilinear(s: ShadowPoint, offset_uv: vec2<f32>) -> f32 {
    let uv = s.uv + offset_uv;
    let place = uv * MAP_TEXELS - 0.5;
    let base = floor(place);
    let weight = place - base;
    // Gathered from the corner that the four texels share: a driver's own rounding of `uv` could
    // pick a neighbouring footprint.
    let depths = textureGather(0, shadow_map, nearest, (base + 1.0) / MAP_TEXELS);
    let first = (base + 0.5) / MAP_TEXELS - s.uv;
    let step = 1.0 / MAP_TEXELS;
    let references = reference_quad(s, first, step);
    let lit = select(vec4(0.0), vec4(1.0), references <= depths);
    let mixed = mix(mix(lit.w, lit.z, weight.x), mix(lit.x, lit.y, weight.x), weight.y);
    return select(1.0, mixed, inside_map(uv));
}
