// A pixel that the checkerboard left out, from its four neighbours in the frame, weighted by slot
// `weight` (first seed document, section 3). Where the weights sum up to less than ZERO_BELOW it
// is 0, as in the document's demo; where no neighbour speaks at all it is their plain mean.
@group(0) @binding(6) var packed: texture_2d<f32>;

override ZERO_BELOW: f32;

const BESIDE = array<vec2<i32>, 4>(vec2(-1, 0), vec2(1, 0), vec2(0, -1), vec2(0, 1));

fn filled(r: Receiver, pixel: vec2<i32>) -> f32 {
    var weighted = vec2(0.0);
    var plain = vec2(0.0);
    for (var k = 0u; k < 4u; k++) {
        let neighbour = pixel + BESIDE[k];
        if in_frame(neighbour) {
            let lit = textureLoad(packed, packed_texel(neighbour), 0).x;
            weighted += weight(r, neighbour) * vec2(lit, 1.0);
            plain += vec2(lit, 1.0);
        }
    }
    if weighted.y < ZERO_BELOW {
        return 0.0;
    }
    if weighted.y > 0.0 {
        return weighted.x / weighted.y;
    }
    return plain.x / max(plain.y, 1.0);
}
