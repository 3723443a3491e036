// Blocker search by moments, filter by comparisons (T28): moments leak only into the kernel's size.
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    if !inside_map(s.uv) {
        return 1.0;
    }
    let blocker = moments_blocker(s);
    if blocker < 0.0 {
        return 1.0;
    }
    return filter_disc(s, kernel_radius_uv(s.depth, blocker), TAU * pattern(r.place, r.position));
}
