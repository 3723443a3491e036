// Bilinear-compare taps on Vogel's disc of one radius everywhere (T7, T8).
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    return filter_disc(s, fixed_radius_uv(s.depth), TAU * pattern(r.place));
}
