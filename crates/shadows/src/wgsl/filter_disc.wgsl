// Slot `filter_disc`: percentage-closer filtering, the lit share of bilinear-compare taps in a disc.
override FILTER_TAPS: u32;

fn filter_disc(s: ShadowPoint, radius_uv: f32, angle: f32) -> f32 {
    return filter_disc_of(s, radius_uv, angle, FILTER_TAPS);
}

// With another number of taps.
fn filter_disc_of(s: ShadowPoint, radius_uv: f32, angle: f32, taps: u32) -> f32 {
    let turn = turn_of(angle);
    var lit = 0.0;
    for (var i = 0u; i < taps; i++) {
        lit += lit_bilinear(s, radius_uv * kernel_tap(i, taps, turn));
    }
    return lit / f32(taps);
}
