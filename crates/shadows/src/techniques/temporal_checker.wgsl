// A checkerboard that flips in every frame (T15): what this frame left out, the one before computed.
// The receiver is looked up where the frame before saw it, between the four pixels nearest to it
// that it computed (they make a grid that is turned by 45 degrees: bilinear in it, so that a still
// camera finds the very pixel). One of them counts if its surface lies in the receiver's plane, to
// AGREEMENT of its depth. Where less than half of the weight counts, the pixel is filled from this
// frame's neighbours. An anchor reads as the pixel that it projects to does, with its own place in
// the frame before.
@group(0) @binding(9) var packed_before: texture_2d<f32>;
@group(0) @binding(10) var depth_before: texture_2d<f32>;
@group(0) @binding(11) var<uniform> past: Globals;

override AGREEMENT: f32;

fn shade(r: Receiver) -> f32 {
    let pixel = vec2<i32>(floor(r.place));
    if is_computed(pixel, parity_of(globals.frame_index)) {
        return textureLoad(packed, packed_texel(pixel), 0).x;
    }
    let before = reprojected(r);
    if before.y < 0.5 {
        return filled(r, pixel);
    }
    return before.x / before.y;
}

// Weighted value and weight of what the frame before knows of a receiver.
fn reprojected(r: Receiver) -> vec2<f32> {
    let clip = past.clip_from_world * vec4(r.position, 1.0);
    // Behind the camera it was not seen.
    if clip.w <= 0.0 {
        return vec2(0.0);
    }
    let place = (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * vec2<f32>(past.frame_size) - 0.5;
    let parity = parity_of(past.frame_index);
    let turned_place = 0.5 * (vec2(place.x + place.y, place.x - place.y) + f32(parity));
    let base = floor(turned_place);
    let toward = turned_place - base;
    var sum = vec2(0.0);
    for (var k = 0u; k < 4u; k++) {
        let step = vec2(k & 1u, k >> 1u);
        let diagonal = vec2<i32>(base) + vec2<i32>(step);
        let pixel = vec2(diagonal.x + diagonal.y - parity, diagonal.x - diagonal.y);
        let sides = select(1.0 - toward, toward, step == vec2(1u));
        if in_frame(pixel) && agrees(r, pixel) {
            let lit = textureLoad(packed_before, packed_texel(pixel), 0).x;
            sum += sides.x * sides.y * vec2(lit, 1.0);
        }
    }
    return sum;
}

fn agrees(r: Receiver, before: vec2<i32>) -> bool {
    let depth = textureLoad(depth_before, before, 0).x;
    let there = unprojected(past.world_from_camera, past.half_extent, before, depth);
    return depth > 0.0 && abs(dot(r.normal, there - r.position)) <= AGREEMENT * depth;
}
