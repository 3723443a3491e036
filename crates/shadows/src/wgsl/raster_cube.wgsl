// What the light sees through one face of its cube: the distance, in metres.
override FACE: u32;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    // From the light; its length is taken per fragment, for it is not linear over a triangle.
    @location(0) offset: vec3<f32>,
}

@vertex
fn vertex(@location(0) position: vec3<f32>, @location(1) normal: vec3<f32>) -> Varying {
    let offset = (globals.light_from_world * vec4(position, 1.0)).xyz;
    let seen = on_face(FACE, offset) * vec3(1.0, 1.0, -1.0);
    // The projection expects the world's coordinates: the light stands at -light_from_world[3].
    let turned = vec4(seen - globals.light_from_world[3].xyz, 1.0);
    return Varying(globals.light_clip_from_world * turned, offset);
}

@fragment
fn fragment(in: Varying) -> @location(0) f32 {
    return length(in.offset);
}
