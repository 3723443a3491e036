// Contact hardening with the early-outs of Real-Time Rendering's excerpt (T11e).
override SEARCH_SCALE: f32;
// Kernels of a smaller radius take one tap.
override SHARP_TEXELS: f32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let angle = TAU * pattern(r.place, r.position);
    let tally = blocker_tally(s, SEARCH_SCALE * search_radius_uv(s.depth), angle);
    if tally.y == 0.0 {
        return 1.0;
    }
    if tally.y == f32(SEARCH_TAPS) {
        return 0.0;
    }
    let radius = kernel_radius_uv(s.depth, tally.x / tally.y);
    if radius * f32(globals.map_size) < SHARP_TEXELS {
        return lit_bilinear(s, vec2(0.0));
    }
    return filter_disc(s, radius, angle);
}
