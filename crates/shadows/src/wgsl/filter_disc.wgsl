// Slot `filter_disc`: percentage-closer filtering, the lit share of bilinear-compare taps in a disc.
override FILTER_TAPS: u32;

fn filter_disc(s: ShadowPoint, radius_uv: f32, angle: f32) -> f32 {
    let turn = turn_of(angle);
    var lit = 0.0;
    for (var i = 0u; i < FILTER_TAPS; i++) {
        lit += lit_bilinear(s, radius_uv * kernel_tap(i, FILTER_TAPS, turn));
    }
    return lit / f32(FILTER_TAPS);
}
