// Blocker search by moments, then moments averaged over turned Poisson taps (T26, T27).
// Half the least distance between taps on a disc of diameter 1: the taps' share of the kernel. 0 reads the map's own texels.
override POISSON_RADIUS: f32;
override FILTER_TAPS: u32;
// 1: the listing as printed.
override LISTING: u32;

// The listing computes each tap's place and then reads the centre.
fn tap_offset(radius_uv: f32, i: u32, turn: vec2<f32>) -> vec2<f32> {
    let offset = radius_uv * kernel_tap(i, FILTER_TAPS, turn);
    return select(offset, vec2(0.0), LISTING == 1u);
}

// Moments about the receiver's plane at each tap: with a constant bias the document's own, otherwise
// free of the variance that a tilted receiver spreads over the taps.
fn filter_moments(s: ShadowPoint, radius_uv: f32, turn: vec2<f32>) -> f32 {
    let width = 2.0 * radius_uv * POISSON_RADIUS * f32(globals.map_size);
    var sum = vec2(0.0);
    for (var i = 0u; i < FILTER_TAPS; i++) {
        let offset = tap_offset(radius_uv, i, turn);
        let m = moments_over(s.uv + offset, width);
        let depth = moment_depth(reference_depth(s, offset));
        sum += vec2(m.x - depth, m.y - 2.0 * depth * m.x + depth * depth);
    }
    return upper_bound(sum / f32(FILTER_TAPS), 0.0);
}

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    if !inside_map(s.uv) {
        return 1.0;
    }
    let turn = turn_of(TAU * pattern(r.place, r.position));
    let blocker = moments_blocker(s);
    if blocker >= 0.0 {
        return filter_moments(s, kernel_radius_uv(s.depth, blocker), turn);
    }
    // The listing calls a blocker that it does not find the light itself: the widest kernel.
    if LISTING == 1u {
        return filter_moments(s, search_radius_uv(s.depth), turn);
    }
    return 1.0;
}
