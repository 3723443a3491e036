// Reading and comparing the shadow map's levels of mean depth, as `tap` does its texels. Level 0 is
// the map itself; references are those at the centres of the level's texels.
@group(0) @binding(6) var mean_depths: texture_2d<f32>;

// Width of a texel in map widths.
fn level_texel(level: u32) -> f32 {
    return f32(1u << level) / f32(globals.map_size);
}

// A texel's depth; of the border's where it lies outside.
fn level_depth(texel: vec2<f32>, level: u32) -> f32 {
    let place = max(vec2<i32>(texel), vec2(0));
    if level == 0u {
        return textureLoad(shadow_map, min(place, vec2(i32(globals.map_size) - 1)), 0).x;
    }
    // Not asked of the level: software drivers answer for the first invocation's level alone.
    let last = max(vec2<i32>(textureDimensions(mean_depths)) >> vec2(level - 1u), vec2(1)) - 1;
    return textureLoad(mean_depths, min(place, last), level - 1u).x;
}

fn level_reference(s: ShadowPoint, texel: vec2<f32>, level: u32) -> f32 {
    return reference_depth(s, (texel + 0.5) * level_texel(level) - s.uv);
}

// The depth of the texel that a tap lies in (far away outside the map), and the reference there.
fn nearest_pair_level(s: ShadowPoint, offset_uv: vec2<f32>, level: u32) -> vec2<f32> {
    let uv = s.uv + offset_uv;
    if !inside_map(uv) {
        return vec2(3.0e38, 0.0);
    }
    let texel = floor(uv / level_texel(level));
    return vec2(level_depth(texel, level), level_reference(s, texel, level));
}

fn lit_texel(s: ShadowPoint, texel: vec2<f32>, level: u32) -> f32 {
    return select(0.0, 1.0, level_reference(s, texel, level) <= level_depth(texel, level));
}

fn lit_bilinear_level(s: ShadowPoint, offset_uv: vec2<f32>, level: u32) -> f32 {
    let uv = s.uv + offset_uv;
    if !inside_map(uv) {
        return 1.0;
    }
    let place = uv / level_texel(level) - 0.5;
    let base = floor(place);
    let weight = place - base;
    let above = mix(lit_texel(s, base, level), lit_texel(s, base + vec2(1.0, 0.0), level), weight.x);
    let below = mix(lit_texel(s, base + vec2(0.0, 1.0), level), lit_texel(s, base + 1.0, level), weight.x);
    return mix(above, below, weight.y);
}
