// Contact hardening with the kernel radius from a blurred low-resolution mask (T12).
override MASK_STEP: u32;
// Kernels of a smaller radius, in texels, take half of the taps, those of half of it a quarter, those
// of a quarter one; 0: all take all (T11e, tap count by width).
override FEW_TEXELS: f32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let radius = fetch_bilinear(r.place / f32(MASK_STEP));
    let texels = radius * MAP_TEXELS;
    // Where the mask holds no penumbra all taps are the same one.
    if radius == 0.0 || texels < 0.25 * FEW_TEXELS {
        return lit_bilinear(s, vec2(0.0));
    }
    let angle = TAU * pattern(r.place, r.position);
    if texels < FEW_TEXELS {
        let taps = select(FILTER_TAPS / 2u, FILTER_TAPS / 4u, texels < 0.5 * FEW_TEXELS);
        return filter_disc_of(s, radius, angle, taps);
    }
    return filter_disc(s, radius, angle);
}
