// Half of the pixels, the others from their neighbours (T14). An anchor reads as the pixel that it
// projects to does: that pixel's own value where the checkerboard computed it, otherwise its four
// neighbours, weighted by the anchor's own depth or plane. So a whole pixel shares the values
// that its anchors read, and an anchor that creeps through it sees steps of a pixel.
fn shade(r: Receiver) -> f32 {
    let pixel = vec2<i32>(floor(r.place));
    if is_computed(pixel, parity_of(globals.frame_index)) {
        return textureLoad(packed, packed_texel(pixel), 0).x;
    }
    return filled(r, pixel);
}
