// The shadow of a smaller target, fetched bilinearly at the receiver's own place, each of the four
// texels weighted besides by slot `weight` for the surface that it was computed on (T14c).
@group(0) @binding(6) var coarse: texture_2d<f32>;

fn shade(r: Receiver) -> f32 {
    let scale = f32(SCALE_NUMERATOR) / f32(SCALE_DENOMINATOR);
    let corner = r.place * scale - 0.5;
    let base = floor(corner);
    let toward = corner - base;
    let last = vec2<i32>(textureDimensions(coarse)) - 1;
    var weighted = vec2(0.0);
    var plain = 0.0;
    for (var k = 0u; k < 4u; k++) {
        let step = vec2(k & 1u, k >> 1u);
        let texel = clamp(vec2<i32>(base) + vec2<i32>(step), vec2(0), last);
        let lit = textureLoad(coarse, texel, 0).x;
        let sides = select(1.0 - toward, toward, step == vec2(1u));
        let share = sides.x * sides.y;
        weighted += share * weight(r, vec2<i32>(target_pixel(vec2<u32>(texel)))) * vec2(lit, 1.0);
        plain += share * lit;
    }
    // No texel speaks where none sees a surface.
    return select(plain, weighted.x / weighted.y, weighted.y > 0.0);
}
