// One lookup of filtered moments, one bound (T23 to T25). FIXED_KERNEL 1: over a square as wide as
// the fixed kernel; 0: the texture holds its own filter.
override FIXED_KERNEL: u32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    if !inside_map(s.uv) {
        return 1.0;
    }
    var width = 1.0;
    if FIXED_KERNEL == 1u {
        width = 2.0 * fixed_radius_uv(s.depth) * f32(globals.map_size);
    }
    return lit_share(moments_over(s.uv, width), moment_depth(reference_depth(s, vec2(0.0))));
}
