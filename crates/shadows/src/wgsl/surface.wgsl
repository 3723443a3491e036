// The surface at a pixel centre, from the depth prepass.
@group(0) @binding(2) var camera_depth: texture_2d<f32>;
@group(0) @binding(3) var camera_normal: texture_2d<f32>;

struct Receiver {
    position: vec3<f32>,
    normal: vec3<f32>,
    // Where it is seen, in pixels of the frame (centres at +0.5).
    place: vec2<f32>,
    // False where the camera sees nothing.
    seen: bool,
}

fn surface_at(pixel: vec2<u32>) -> Receiver {
    let depth = textureLoad(camera_depth, pixel, 0).x;
    let place = vec2<f32>(pixel) + 0.5;
    let ndc = (place / vec2<f32>(globals.frame_size) - 0.5) * vec2(2.0, -2.0);
    let camera = vec4(vec3(ndc * globals.half_extent, -1.0) * depth, 1.0);
    let position = (globals.world_from_camera * camera).xyz;
    let normal = normalize(textureLoad(camera_normal, pixel, 0).xyz + vec3(0.0, 1e-20, 0.0));
    return Receiver(position, normal, place, depth > 0.0);
}
