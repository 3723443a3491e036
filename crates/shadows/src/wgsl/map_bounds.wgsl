// Bounds of the shadow map's depths over a square, from the pyramid of least and largest depth.
@group(0) @binding(6) var pyramid: texture_2d<f32>;

struct MapBounds {
    // Least and largest depth of the square's texels inside the map; (3e38, -3e38) without any.
    depths: vec2<f32>,
    // Whether no part of the square is outside the map.
    inside: bool,
    // Texels of the pyramid that were read.
    fetches: u32,
}

// The square of this half-side round a place, both in map widths.
fn map_bounds(uv: vec2<f32>, half_side: f32) -> MapBounds {
    let size = i32(globals.map_size);
    let low = vec2<i32>(floor(clamp((uv - half_side) * f32(size), vec2(-2.0), vec2(f32(size) + 2.0))));
    let high = vec2<i32>(floor(clamp((uv + half_side) * f32(size), vec2(-2.0), vec2(f32(size) + 2.0))));
    var bounds = MapBounds(vec2(3.0e38, -3.0e38), all(low >= vec2(0)) && all(high < vec2(size)), 0u);
    if any(high < vec2(0)) || any(low >= vec2(size)) {
        return bounds;
    }
    let level = bounds_level(high - low);
    // Not asked of the level: software drivers answer for the first invocation's level alone.
    let last = max(vec2<i32>(textureDimensions(pyramid)) >> vec2(u32(level)), vec2(1)) - 1;
    // Level 0 of the pyramid is the halved map.
    let first = min(max(low, vec2(0)) >> vec2(u32(level) + 1u), last);
    let end = min(min(high, vec2(size - 1)) >> vec2(u32(level) + 1u), last);
    for (var y = first.y; y <= end.y; y++) {
        for (var x = first.x; x <= end.x; x++) {
            let range = textureLoad(pyramid, vec2(x, y), level).xy;
            bounds.depths = vec2(min(bounds.depths.x, range.x), max(bounds.depths.y, range.y));
            bounds.fetches++;
        }
    }
    return bounds;
}

// The finest level of which BOUNDS_SIDE texels a side cover the square wherever it lies.
override BOUNDS_SIDE: i32;

fn bounds_level(across: vec2<i32>) -> i32 {
    let widest = max(max(across.x, across.y), 1);
    var level = 0;
    while ((BOUNDS_SIDE - 1) << u32(level + 1)) < widest && level < 30 {
        level++;
    }
    return min(level, i32(textureNumLevels(pyramid)) - 1);
}
