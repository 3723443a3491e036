// A checkerboard and its packed target, half as wide (first seed document, listing 7): even rows
// hold even x, odd rows odd x; with `FLIPS` 1 the other way round in every second frame.
override FLIPS: u32;

fn parity_of(frame_index: u32) -> i32 {
    return i32(FLIPS * (frame_index & 1u));
}

fn is_computed(pixel: vec2<i32>, parity: i32) -> bool {
    return ((pixel.x + pixel.y + parity) & 1) == 0;
}

fn packed_texel(pixel: vec2<i32>) -> vec2<i32> {
    return vec2(pixel.x >> 1u, pixel.y);
}
