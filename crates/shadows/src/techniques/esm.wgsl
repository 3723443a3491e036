// Exponential shadow map (T30; Annen et al. 2008): the mean of exp(c z) over the fixed kernel times
// exp(-c z) of the receiver, both relative to the far plane.
override ESM_SHARPNESS: f32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    if !inside_map(s.uv) {
        return 1.0;
    }
    let width = 2.0 * fixed_radius_uv(s.depth) * f32(globals.map_size);
    let before_far = globals.far - reference_depth(s, vec2(0.0));
    return saturate(moments_over(s.uv, width).x * exp(min(ESM_SHARPNESS * before_far, 80.0)));
}
