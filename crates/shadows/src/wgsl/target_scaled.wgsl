// Slot `target_pixel`, `target_place`: the pixel of the frame nearest to the centre of a texel of a
// smaller target (of two equally near ones the later), which has SCALE_NUMERATOR texels on
// SCALE_DENOMINATOR pixels of a side; patterns are laid out over the target's texels.
override SCALE_NUMERATOR: u32;
override SCALE_DENOMINATOR: u32;

fn target_pixel(texel: vec2<u32>) -> vec2<u32> {
    let pixel = (2u * texel + 1u) * SCALE_DENOMINATOR / (2u * SCALE_NUMERATOR);
    return min(pixel, globals.frame_size - 1u);
}

fn target_place(texel: vec2<u32>) -> vec2<f32> {
    return vec2<f32>(texel) + 0.5;
}
