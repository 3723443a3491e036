// Blocker search and filter, each a lookup of moments over a square (T25, T26).
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    if !inside_map(s.uv) {
        return 1.0;
    }
    let blocker = moments_blocker(s);
    if blocker < 0.0 {
        return 1.0;
    }
    let width = 2.0 * kernel_radius_uv(s.depth, blocker) * f32(globals.map_size);
    return upper_bound(moments_over(s.uv, width), moment_depth(reference_depth(s, vec2(0.0))));
}
