// Contact hardening with early-outs by a pyramid of least and largest depth (T19): where its bounds
// decide, chss would say the same; elsewhere it is asked.
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let early = early_out(s, SEARCH_SCALE * search_radius_uv(s.depth));
    if early.verdict == ALL_LIT {
        return 1.0;
    }
    if early.verdict == ALL_DARK {
        return 0.0;
    }
    return harden(s, TAU * pattern(r.place, r.position));
}
