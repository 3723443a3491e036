// Mean depth of the blockers in a disc (first seed document, listing 3); negative without any.
override SEARCH_TAPS: u32;

// Sum of the blockers' depths, and how many they are.
fn blocker_tally(s: ShadowPoint, radius_uv: f32, angle: f32) -> vec2<f32> {
    let turn = turn_of(angle);
    var sum = 0.0;
    var count = 0.0;
    for (var i = 0u; i < SEARCH_TAPS; i++) {
        let pair = nearest_pair(s, radius_uv * kernel_tap(i, SEARCH_TAPS, turn));
        if pair.x < pair.y {
            sum += pair.x;
            count += 1.0;
        }
    }
    return vec2(sum, count);
}

fn mean_blocker(s: ShadowPoint, radius_uv: f32, angle: f32) -> f32 {
    let tally = blocker_tally(s, radius_uv, angle);
    let sum = tally.x;
    let count = tally.y;
    return select(-1.0, sum / count, count > 0.0);
}
