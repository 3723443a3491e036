// Slot `receiver`: the pixels of the frame, as engines shade them (pictures, costs).
fn receiver_index(id: vec3<u32>) -> u32 {
    if any(id.xy >= globals.frame_size) {
        return 0xffffffffu;
    }
    return id.y * globals.frame_size.x + id.x;
}

fn receiver(index: u32) -> Receiver {
    return surface_at(vec2(index % globals.frame_size.x, index / globals.frame_size.x));
}
