// Slot `moments_over`: means over a square of any width from a summed-area table (Crow 1984; third
// seed document). Its part outside the map is cut off.
@group(0) @binding(6) var sums: texture_2d<u32>;

// Bits of a stored fraction, and the widest box in texels whose sum stays below 2^31.
override TABLE_BITS: u32;
override TABLE_WIDEST: f32;

// Sum of everything left of and above a corner between texels.
fn sum_before(corner: vec2<u32>) -> vec2<u32> {
    if any(corner == vec2(0u)) {
        return vec2(0u);
    }
    return textureLoad(sums, corner - 1u, 0).xy;
}

// Sum of a box between corners. Sums wrap, and so do their differences: back to the box's own.
// Signed, for a box that rounding turned inside out.
fn sum_within(low: vec2<u32>, high: vec2<u32>) -> vec2<f32> {
    let above = sum_before(vec2(high.x, low.y)) - sum_before(low);
    let all = sum_before(high) - sum_before(vec2(low.x, high.y));
    return vec2<f32>(bitcast<vec2<i32>>(all - above));
}

// Edges between texels: the table is interpolated bilinearly at each of the four corners, which is
// a mean over the sixteen boxes of whole texels that they may stand for.
fn moments_over(uv: vec2<f32>, width_texels: f32) -> vec2<f32> {
    let size = f32(globals.map_size);
    let half_width = 0.5 * clamp(width_texels, 1.0, TABLE_WIDEST);
    let low = clamp(uv * size - half_width, vec2(0.0), vec2(size));
    let high = clamp(uv * size + half_width, vec2(0.0), vec2(size));
    let first = vec2<u32>(low);
    let last = vec2<u32>(high);
    let weight_low = low - floor(low);
    let weight_high = high - floor(high);
    var sum = vec2(0.0);
    for (var k = 0u; k < 16u; k++) {
        let at_low = vec2(k & 1u, (k >> 1u) & 1u);
        let at_high = vec2((k >> 2u) & 1u, k >> 3u);
        let weights = mix(1.0 - weight_low, weight_low, vec2<f32>(at_low))
            * mix(1.0 - weight_high, weight_high, vec2<f32>(at_high));
        if all(weights > vec2(0.0)) {
            sum += weights.x * weights.y * sum_within(first + at_low, last + at_high);
        }
    }
    let area = (high.x - low.x) * (high.y - low.y);
    let mean = sum / (area * (exp2(f32(TABLE_BITS)) - 1.0));
    // Back from fractions of the depths that there are.
    let unit = 0.5 * (globals.far - globals.nearest_blocker) / globals.far;
    return vec2((2.0 * mean.x - 1.0) * unit, mean.y * unit * unit);
}
