// Slot `filter_disc`: the same with one comparison a tap, as the second and fourth seed documents
// have it.
override FILTER_TAPS: u32;

fn filter_disc(s: ShadowPoint, radius_uv: f32, angle: f32) -> f32 {
    let turn = turn_of(angle);
    var lit = 0.0;
    for (var i = 0u; i < FILTER_TAPS; i++) {
        lit += lit_nearest(s, radius_uv * kernel_tap(i, FILTER_TAPS, turn));
    }
    return lit / f32(FILTER_TAPS);
}
