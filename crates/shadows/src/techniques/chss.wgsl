// Contact hardening at full resolution (T11): blocker search, kernel radius, filter; one pattern
// serves both loops, as in the document.
override SEARCH_SCALE: f32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let angle = TAU * pattern(r.place, r.position);
    let blocker = mean_blocker(s, SEARCH_SCALE * search_radius_uv(s.depth), angle);
    if blocker < 0.0 {
        return filter_disc(s, 0.0, angle);
    }
    return filter_disc(s, kernel_radius_uv(s.depth, blocker), angle);
}
