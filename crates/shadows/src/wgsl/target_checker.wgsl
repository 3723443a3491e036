// Slot `target_pixel`, `target_place`: the pixel of the frame that a texel of a packed checkerboard
// stands for; patterns are laid out over the frame's pixels.
fn target_pixel(texel: vec2<u32>) -> vec2<u32> {
    let odd = (texel.y + u32(parity_of(globals.frame_index))) & 1u;
    return vec2(2u * texel.x + odd, texel.y);
}

fn target_place(texel: vec2<u32>) -> vec2<f32> {
    return vec2<f32>(target_pixel(texel)) + 0.5;
}
