// Contact hardening whose search knows several layers of the map (T22): at each tap the deepest
// blocker counts, the one that is nearest to the receiver. The filter reads the first layer.
@group(0) @binding(6) var layer_2: texture_2d<f32>;
@group(0) @binding(9) var layer_3: texture_2d<f32>;
@group(0) @binding(10) var layer_4: texture_2d<f32>;

override LAYERS: u32;
override SEARCH_SCALE: f32;
override SEARCH_TAPS: u32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let angle = TAU * pattern(r.place, r.position);
    let blocker = mean_deepest(s, SEARCH_SCALE * search_radius_uv(s.depth), angle);
    if blocker < 0.0 {
        return filter_disc(s, 0.0, angle);
    }
    return filter_disc(s, kernel_radius_uv(s.depth, blocker), angle);
}

fn mean_deepest(s: ShadowPoint, radius_uv: f32, angle: f32) -> f32 {
    let turn = turn_of(angle);
    var sum = 0.0;
    var count = 0.0;
    for (var i = 0u; i < SEARCH_TAPS; i++) {
        let offset = radius_uv * kernel_tap(i, SEARCH_TAPS, turn);
        let pair = nearest_pair(s, offset);
        if pair.x < pair.y {
            let texel = vec2<u32>(floor((s.uv + offset) * f32(globals.map_size)));
            sum += deepest_before(texel, pair);
            count += 1.0;
        }
    }
    return select(-1.0, sum / count, count > 0.0);
}

// The deepest layer before the reference `pair.y`; `pair.x` is the first.
fn deepest_before(texel: vec2<u32>, pair: vec2<f32>) -> f32 {
    var deepest = nearer(pair, textureLoad(layer_2, texel, 0).x);
    if LAYERS > 2u {
        deepest = nearer(vec2(deepest, pair.y), textureLoad(layer_3, texel, 0).x);
        deepest = nearer(vec2(deepest, pair.y), textureLoad(layer_4, texel, 0).x);
    }
    return deepest;
}

fn nearer(pair: vec2<f32>, next: f32) -> f32 {
    return select(pair.x, next, next < pair.y);
}
