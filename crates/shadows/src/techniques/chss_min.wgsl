// Contact hardening with the nearest depth of a region of the shadow map, blurred, as the blocker
// (T13). Blurring may push it behind the receiver: then the kernel is a point.
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let size = vec2<f32>(textureDimensions(source));
    let blocker = min(fetch_bilinear(s.uv * size), s.depth);
    return filter_disc(s, kernel_radius_uv(s.depth, blocker), TAU * pattern(r.place, r.position));
}
