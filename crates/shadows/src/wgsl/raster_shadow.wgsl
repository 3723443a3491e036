// What the light sees: linear depth along the light's viewing direction, in metres.
struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) depth: f32,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> Varying {
    let world = vec4(position, 1.0);
    return Varying(globals.light_clip_from_world * world, -(globals.light_from_world * world).z);
}

@fragment
fn fragment(in: Varying) -> @location(0) f32 {
    return in.depth;
}
