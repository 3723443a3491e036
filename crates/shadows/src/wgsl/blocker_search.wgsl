// Depths of the blockers in a disc (first seed document, listing 3).
override SEARCH_TAPS: u32;

// Sum of the blockers' depths, and how many there are, over one in `stride` taps from `first` on.
fn tally_part(s: ShadowPoint, radius_uv: f32, turn: vec2<f32>, first: u32, stride: u32) -> vec2<f32> {
    var sum = 0.0;
    var count = 0.0;
    for (var i = first; i < SEARCH_TAPS; i += stride) {
        let pair = nearest_pair(s, radius_uv * kernel_tap(i, SEARCH_TAPS, turn));
        if pair.x < pair.y {
            sum += pair.x;
            count += 1.0;
        }
    }
    return vec2(sum, count);
}

fn blocker_tally(s: ShadowPoint, radius_uv: f32, angle: f32) -> vec2<f32> {
    return tally_part(s, radius_uv, turn_of(angle), 0u, 1u);
}

// Their mean depth; negative without any.
fn mean_blocker(s: ShadowPoint, radius_uv: f32, angle: f32) -> f32 {
    let tally = blocker_tally(s, radius_uv, angle);
    return select(-1.0, tally.x / tally.y, tally.y > 0.0);
}
