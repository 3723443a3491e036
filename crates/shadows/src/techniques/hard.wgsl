// One comparison with the nearest texel (T1).
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    return lit_nearest(s, vec2(0.0));
}
