// Slot `summand`: a table of sums along the other axis.
@group(0) @binding(6) var source: texture_2d<u32>;

fn summand(texel: vec2<u32>) -> vec2<u32> {
    return textureLoad(source, texel, 0).xy;
}
