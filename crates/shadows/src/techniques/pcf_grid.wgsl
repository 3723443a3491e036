// The mean of comparisons on a square grid (T3), or of interpolated ones (T4).
override GRID_SIDE: u32;
// Distance between taps in texels; 0 = the light-matched kernel (square of the same half-side).
override GRID_STEP_TEXELS: f32;
// 1: each tap compares four texels.
override GRID_BILINEAR: u32;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let half_side = f32(GRID_SIDE - 1u) * 0.5;
    var step_uv = GRID_STEP_TEXELS / f32(globals.map_size);
    if GRID_STEP_TEXELS == 0.0 {
        step_uv = fixed_radius_uv(s.depth) / half_side;
    }
    var lit = 0.0;
    for (var y = 0u; y < GRID_SIDE; y++) {
        for (var x = 0u; x < GRID_SIDE; x++) {
            let offset = (vec2(f32(x), f32(y)) - half_side) * step_uv;
            if GRID_BILINEAR == 1u {
                lit += lit_bilinear(s, offset);
            } else {
                lit += lit_nearest(s, offset);
            }
        }
    }
    return lit / f32(GRID_SIDE * GRID_SIDE);
}
