// As `raster_camera`, for surfaces that are cut out.
struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) @interpolate(flat) normal: vec3<f32>,
    @location(2) depth: f32,
    @location(3) uv: vec2<f32>,
    @location(4) @interpolate(flat) mask: u32,
}

struct Surface {
    @location(0) depth: f32,
    @location(1) normal: vec4<f32>,
}

@vertex
fn vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) mask: u32,
) -> Varying {
    let clip = globals.clip_from_world * vec4(position, 1.0);
    return Varying(clip, position, normal, clip.w, uv, mask);
}

@fragment
fn fragment(in: Varying) -> Surface {
    if !is_there(in.uv, in.mask) {
        discard;
    }
    let to_eye = globals.world_from_camera[3].xyz - in.world;
    let normal = select(-in.normal, in.normal, dot(in.normal, to_eye) >= 0.0);
    return Surface(in.depth, vec4(normal, 0.0));
}
