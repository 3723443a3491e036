// The share of chss's fetches that chss-minmax still makes, its own of the pyramid included.
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let early = early_out(s, SEARCH_SCALE * search_radius_uv(s.depth));
    let all = SEARCH_TAPS + FILTER_TAPS;
    return f32(early.fetches + select(0u, all, early.verdict == UNDECIDED)) / f32(all);
}
