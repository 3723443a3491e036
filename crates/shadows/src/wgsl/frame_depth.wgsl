// What the frame knows of depths near a receiver: for the weights of an upsample. `DEPTH_BITS` 16
// keeps depths as half floats, as the first seed document's demo may; 32 as they are.
override DEPTH_BITS: u32;

// A half float has 10 bits after the leading one: the other 13 are rounded to the nearest, ties to
// even. By hand, for WGSL leaves the direction open; true of depths from 0.1 mm to 65 km.
fn kept_depth(depth: f32) -> f32 {
    if DEPTH_BITS == 16u {
        let bits = bitcast<u32>(depth);
        return bitcast<f32>((bits + 0xfffu + ((bits >> 13u) & 1u)) & 0xffffe000u);
    }
    return depth;
}

// 0 where nothing is seen.
fn depth_at(pixel: vec2<i32>) -> f32 {
    return kept_depth(textureLoad(camera_depth, pixel, 0).x);
}

fn in_frame(pixel: vec2<i32>) -> bool {
    return all(pixel >= vec2(0)) && all(pixel < vec2<i32>(globals.frame_size));
}

// A perspective projection's w is the depth along the viewing direction.
fn view_depth(position: vec3<f32>) -> f32 {
    return (globals.clip_from_world * vec4(position, 1.0)).w;
}

// The point that a camera of this pose and half-extent sees at a pixel's centre, at a depth.
fn unprojected(
    world_from_camera: mat4x4<f32>,
    half_extent: vec2<f32>,
    pixel: vec2<i32>,
    depth: f32,
) -> vec3<f32> {
    let place = (vec2<f32>(pixel) + 0.5) / vec2<f32>(globals.frame_size);
    let across = (place - 0.5) * vec2(2.0, -2.0) * half_extent;
    return (world_from_camera * vec4(vec3(across, -1.0) * depth, 1.0)).xyz;
}
