// The light's hidden share as a bit for each of 64 places on it (T21; Schwarz and Stamminger 2007):
// what two patches hide counts once.
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    let cells = cells_of(s);
    var places: array<vec2<f32>, 64>;
    for (var i = 0u; i < 64u; i++) {
        places[i] = kernel_tap(i, 64u, vec2(1.0, 0.0));
    }
    var seen = vec2(0xffffffffu);
    for (var k = 0; k < cells.count.x * cells.count.y && any(seen != vec2(0u)); k++) {
        let rectangle = patch_of(s, cells, k);
        if all(rectangle.xy < vec2(1.0)) && all(rectangle.zw > vec2(-1.0)) {
            for (var word = 0u; word < 2u; word++) {
                // Only places that are still seen can be hidden.
                for (var left = seen[word]; left != 0u; left &= left - 1u) {
                    let bit = firstTrailingBit(left);
                    let place = places[32u * word + bit];
                    if all(place >= rectangle.xy) && all(place < rectangle.zw) {
                        seen[word] &= ~(1u << bit);
                    }
                }
            }
        }
    }
    return f32(countOneBits(seen.x) + countOneBits(seen.y)) / 64.0;
}
