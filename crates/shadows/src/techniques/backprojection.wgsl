// The light's hidden area as the sum of all patches' (T21), overlaps counted twice.
const PI: f32 = 3.14159265358979;

fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let cells = cells_of(s);
    var hidden = 0.0;
    for (var k = 0; k < cells.count.x * cells.count.y && hidden < PI; k++) {
        hidden += area_in_disc(patch_of(s, cells, k));
    }
    return 1.0 - saturate(hidden / PI);
}

// Area of a rectangle (lower, upper corner) inside the unit disc.
fn area_in_disc(rectangle: vec4<f32>) -> f32 {
    let low = clamp(rectangle.xy, vec2(-1.0), vec2(1.0));
    let high = clamp(rectangle.zw, vec2(-1.0), vec2(1.0));
    if any(low >= high) {
        return 0.0;
    }
    return quarter(high) - quarter(vec2(low.x, high.y)) - quarter(vec2(high.x, low.y)) + quarter(low);
}

// Area of the rectangle from the centre to a corner inside the unit disc, negative in the second
// and fourth quadrant.
fn quarter(corner: vec2<f32>) -> f32 {
    let c = abs(corner);
    let sign = select(-1.0, 1.0, corner.x * corner.y >= 0.0);
    if dot(c, c) <= 1.0 {
        return sign * c.x * c.y;
    }
    // Up to where the circle comes down to the rectangle's upper side, that side bounds the area.
    let flat = sqrt(max(1.0 - c.y * c.y, 0.0));
    return sign * (c.y * flat + under_circle(c.x) - under_circle(flat));
}

// Area under the unit circle's upper half from 0 to x.
fn under_circle(x: f32) -> f32 {
    return 0.5 * (x * sqrt(max(1.0 - x * x, 0.0)) + asin(min(x, 1.0)));
}
