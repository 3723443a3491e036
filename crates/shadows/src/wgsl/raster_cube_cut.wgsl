// As `raster_cube`, for surfaces that are cut out.
override FACE: u32;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) offset: vec3<f32>,
    @location(1) uv: vec2<f32>,
    @location(2) @interpolate(flat) mask: u32,
}

@vertex
fn vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) mask: u32,
) -> Varying {
    let offset = (globals.light_from_world * vec4(position, 1.0)).xyz;
    let seen = on_face(FACE, offset) * vec3(1.0, 1.0, -1.0);
    let turned = vec4(seen - globals.light_from_world[3].xyz, 1.0);
    return Varying(globals.light_clip_from_world * turned, offset, uv, mask);
}

@fragment
fn fragment(in: Varying) -> @location(0) f32 {
    if !is_there(in.uv, in.mask) {
        discard;
    }
    return length(in.offset);
}
