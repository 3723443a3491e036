// Contact hardening at full resolution (T11): blocker search, kernel radius, filter; one pattern
// serves both loops, as in the document.
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    return harden(s, TAU * pattern(r.place, r.position));
}
