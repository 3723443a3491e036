// Slot `grid`: a target with a texel for every pixel, read as a packed checkerboard is. What differs
// from shading the receivers themselves is what that reading does.
fn parity_of(frame_index: u32) -> i32 {
    return 0;
}

fn is_computed(pixel: vec2<i32>, parity: i32) -> bool {
    return true;
}

fn packed_texel(pixel: vec2<i32>) -> vec2<i32> {
    return pixel;
}

fn target_pixel(texel: vec2<u32>) -> vec2<u32> {
    return texel;
}

fn target_place(texel: vec2<u32>) -> vec2<f32> {
    return vec2<f32>(texel) + 0.5;
}
