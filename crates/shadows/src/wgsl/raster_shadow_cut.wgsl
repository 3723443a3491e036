// As `raster_shadow`, for surfaces that are cut out.
struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) depth: f32,
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
    let world = vec4(position, 1.0);
    let depth = -(globals.light_from_world * world).z;
    return Varying(globals.light_clip_from_world * world, depth, uv, mask);
}

@fragment
fn fragment(in: Varying) -> @location(0) f32 {
    if !is_there(in.uv, in.mask) {
        discard;
    }
    return in.depth;
}
