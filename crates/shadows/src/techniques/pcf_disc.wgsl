// Taps on a disc of one radius everywhere (T5 to T10, T31).
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    return filter_disc(s, fixed_radius_uv(s.depth), TAU * pattern(r.place, r.position));
}
