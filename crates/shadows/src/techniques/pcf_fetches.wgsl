// A probe: the fetches of a 16-tap disc and nothing else, for the time that they need. Places are those
// of the filter; the depths are summed, which is no shadow.
override FILTER_TAPS: u32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let turn = turn_of(TAU * pattern(r.place, r.position));
    let radius = fixed_radius_uv(s.depth);
    var sum = vec4(0.0);
    for (var i = 0u; i < FILTER_TAPS; i++) {
        let uv = s.uv + radius * kernel_tap(i, FILTER_TAPS, turn);
        sum += textureGather(0, shadow_map, nearest, uv);
    }
    return sum.x + sum.y + sum.z + sum.w;
}
