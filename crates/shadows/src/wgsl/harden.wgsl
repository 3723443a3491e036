// Blocker search, kernel radius, filter: what `chss` does at a receiver.
override SEARCH_SCALE: f32;

fn harden(s: ShadowPoint, angle: f32) -> f32 {
    let blocker = mean_blocker(s, SEARCH_SCALE * search_radius_uv(s.depth), angle);
    if blocker < 0.0 {
        return filter_disc(s, 0.0, angle);
    }
    return filter_disc(s, kernel_radius_uv(s.depth, blocker), angle);
}
