// Contact hardening whose far taps read coarser levels of the map (T17), in search and filter.
override SEARCH_SCALE: f32;
override SEARCH_TAPS: u32;
override FILTER_TAPS: u32;
// Taps farther than twice this distance read level 1, farther than four times level 2.
override FAR_TEXELS: f32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let turn = turn_of(TAU * pattern(r.place, r.position));
    let blocker = mean_blocker_levels(s, SEARCH_SCALE * search_radius_uv(s.depth), turn);
    var radius = 0.0;
    if blocker >= 0.0 {
        radius = kernel_radius_uv(s.depth, blocker);
    }
    var lit = 0.0;
    for (var i = 0u; i < FILTER_TAPS; i++) {
        let offset = radius * kernel_tap(i, FILTER_TAPS, turn);
        lit += lit_bilinear_level(s, offset, level_at(offset));
    }
    return lit / f32(FILTER_TAPS);
}

fn mean_blocker_levels(s: ShadowPoint, radius_uv: f32, turn: vec2<f32>) -> f32 {
    var sum = 0.0;
    var count = 0.0;
    for (var i = 0u; i < SEARCH_TAPS; i++) {
        let offset = radius_uv * kernel_tap(i, SEARCH_TAPS, turn);
        let pair = nearest_pair_level(s, offset, level_at(offset));
        if pair.x < pair.y {
            sum += pair.x;
            count += 1.0;
        }
    }
    return select(-1.0, sum / count, count > 0.0);
}

// floor(log2(distance / FAR_TEXELS)), 0 to 2.
fn level_at(offset_uv: vec2<f32>) -> u32 {
    let distance = length(offset_uv) * f32(globals.map_size);
    return u32(distance >= 2.0 * FAR_TEXELS) + u32(distance >= 4.0 * FAR_TEXELS);
}
