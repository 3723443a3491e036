// A checkerboard that flips in every frame (T15): what this frame left out, the one before computed.
// The receiver is looked up where the frame before saw it, at the nearest pixel that it computed;
// the value counts if the surface there lies in the receiver's plane, to AGREEMENT of its depth.
// Otherwise the pixel is filled from this frame's neighbours. An anchor reads as the pixel that it
// projects to does, with its own place in the frame before.
@group(0) @binding(9) var packed_before: texture_2d<f32>;
@group(0) @binding(10) var depth_before: texture_2d<f32>;
@group(0) @binding(11) var<uniform> past: Globals;

override AGREEMENT: f32;

fn shade(r: Receiver) -> f32 {
    let pixel = vec2<i32>(floor(r.place));
    if is_computed(pixel, parity_of(globals.frame_index)) {
        return textureLoad(packed, packed_texel(pixel), 0).x;
    }
    let before = computed_before(r.position);
    if in_frame(before) && agrees(r, before) {
        return textureLoad(packed_before, packed_texel(before), 0).x;
    }
    return filled(r, pixel);
}

// The pixel nearest to a point among those that the frame before computed; outside the frame where
// the point lay behind the camera.
fn computed_before(position: vec3<f32>) -> vec2<i32> {
    let clip = past.clip_from_world * vec4(position, 1.0);
    if clip.w <= 0.0 {
        return vec2(-1);
    }
    let place = (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * vec2<f32>(past.frame_size);
    let pixel = vec2<i32>(floor(place));
    if is_computed(pixel, parity_of(past.frame_index)) {
        return pixel;
    }
    let lean = place - floor(place) - 0.5;
    let step = select(vec2(1), vec2(-1), lean < vec2(0.0));
    return pixel + select(vec2(0, step.y), vec2(step.x, 0), abs(lean.x) >= abs(lean.y));
}

fn agrees(r: Receiver, before: vec2<i32>) -> bool {
    let depth = textureLoad(depth_before, before, 0).x;
    let there = unprojected(past.world_from_camera, past.half_extent, before, depth);
    return depth > 0.0 && abs(dot(r.normal, there - r.position)) <= AGREEMENT * depth;
}
