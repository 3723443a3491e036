// Contact hardening with the kernel radius from a blurred low-resolution mask (T12).
override MASK_STEP: u32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let radius = fetch_bilinear(r.place / f32(MASK_STEP));
    // Where the mask holds no penumbra all taps are the same one.
    if radius == 0.0 {
        return lit_bilinear(s, vec2(0.0));
    }
    return filter_disc(s, radius, TAU * pattern(r.place, r.position));
}
