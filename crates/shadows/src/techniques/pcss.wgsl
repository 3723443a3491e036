// The second seed document's percentage-closer soft shadows: Poisson taps turned by a hash of the
// world position, no filter where nothing blocks.
override SEARCH_TAPS: u32;
override SEARCH_SCALE: f32;
// 1: the mean is over all taps, as its text says; 0: over the blockers, as its code does.
override MEAN_OF_ALL: u32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let angle = TAU * pattern(r.place, r.position);
    let turn = turn_of(angle);
    let radius = SEARCH_SCALE * search_radius_uv(s.depth);
    var sum = 0.0;
    var blockers = 0.0;
    for (var i = 0u; i < SEARCH_TAPS; i++) {
        let pair = nearest_pair(s, radius * kernel_tap(i, SEARCH_TAPS, turn));
        let blocks = pair.x < pair.y;
        // A tap that finds no surface has nothing to add to a mean either.
        if blocks || (MEAN_OF_ALL == 1u && pair.x < 1.0e38) {
            sum += pair.x;
            blockers += 1.0;
        }
    }
    if blockers == 0.0 {
        return 1.0;
    }
    return filter_disc(s, kernel_radius_uv(s.depth, sum / blockers), angle);
}
