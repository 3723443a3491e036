//! name = "steady"
//! title = "contact hardening with the same 64 points at every receiver: nothing to swim"
//! pattern = "none"
//! search_taps = 64
//! filter_taps = 64
//!
//! [constants]
//! narrowest_texels = 1.0   # below this a kernel shows the map's own steps

// Everything here follows from the receiver's place in the world: the camera may move, the shadow
// stays.
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let blocker = mean_blocker(s, search_radius_uv(s.depth), 0.0);
    if blocker < 0.0 {
        return lit_bilinear(s, vec2(0.0));
    }
    let radius = max(kernel_radius_uv(s.depth, blocker), uv_from_texels(narrowest_texels));
    return filter_disc(s, radius, 0.0);
}
