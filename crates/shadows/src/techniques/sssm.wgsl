// Separable soft shadow mapping (T20), its last pass: a column of the filter's rows.
@group(0) @binding(6) var radii: texture_2d<f32>;
@group(0) @binding(9) var rows: texture_2d<f32>;

fn shade(r: Receiver) -> f32 {
    let own = neighbour(r, 0.0);
    // A point that no pixel speaks for: one tap.
    if !own.found {
        return lit_bilinear(shadow_point(r.position, r.normal), vec2(0.0));
    }
    let half = textureLoad(radii, own.pixel, 0).x;
    var lit = 0.0;
    var count = 0.0;
    for (var k = 0u; k < GRID_SIDE; k++) {
        let n = neighbour(r, grid_offset(k, half));
        if n.found {
            lit += textureLoad(rows, n.pixel, 0).x;
            count += 1.0;
        }
    }
    // The middle tap is the pixel's own, unless rounding moved it.
    return select(textureLoad(rows, own.pixel, 0).x, lit / count, count > 0.0);
}
