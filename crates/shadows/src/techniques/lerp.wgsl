// Four comparisons mixed by the place between their texels (T2): the fourth seed document's
// `texture2DShadowLerp`, with its base and fraction (`LISTING` 1) or with those that belong
// together.
override LISTING: u32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    if LISTING == 0u {
        return lit_bilinear(s, vec2(0.0));
    }
    // The listing: base floor(t + .5) names a texel's edge, while the fraction is that of t - .5.
    // With nearest sampling the edge of a texel belongs to the texel above: the result is displaced
    // by one texel on each axis.
    let size = f32(globals.map_size);
    let place = s.uv * size;
    let weight = fract(place + 0.5);
    let base = floor(place + 0.5);
    let first = (base + 0.5) / size - s.uv;
    let step = 1.0 / size;
    let a = mix(lit_nearest(s, first), lit_nearest(s, first + vec2(0.0, step)), weight.y);
    let b = mix(lit_nearest(s, first + vec2(step, 0.0)), lit_nearest(s, first + step), weight.y);
    return mix(a, b, weight.x);
}
