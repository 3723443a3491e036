// Slot `summand`: depth and its square as fractions of 2^bits - 1. Depth counts from -1 at the nearest
// geometry to 1 at the far plane, and is moved to 0 to 1; the square is that of the centred depth,
// whose fixed point is four times as fine for a variance.
@group(0) @binding(6) var source: texture_2d<f32>;

override TABLE_BITS: u32;

fn summand(texel: vec2<u32>) -> vec2<u32> {
    let half_range = 0.5 * (globals.far - globals.nearest_blocker);
    let depth = textureLoad(source, texel, 0).x - moment_centre();
    let centred = clamp(depth / max(half_range, 1e-20), -1.0, 1.0);
    let fractions = vec2(0.5 * centred + 0.5, centred * centred);
    return vec2<u32>(fractions * (exp2(f32(TABLE_BITS)) - 1.0) + 0.5);
}
