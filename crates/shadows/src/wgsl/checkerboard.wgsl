// Slot `grid`: a checkerboard and its packed target, half as wide (first seed document, listing 7):
// even rows hold even x, odd rows odd x; with `FLIPS` 1 the other way round in every second frame.
// Patterns are laid out over the frame's pixels.
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

fn target_pixel(texel: vec2<u32>) -> vec2<u32> {
    let odd = (texel.y + u32(parity_of(globals.frame_index))) & 1u;
    return vec2(2u * texel.x + odd, texel.y);
}

fn target_place(texel: vec2<u32>) -> vec2<f32> {
    return vec2<f32>(target_pixel(texel)) + 0.5;
}
