// As `raster_peel`, for surfaces that are cut out.
@group(0) @binding(6) var layer_before: texture_2d<f32>;

const LAYER_GAP_WORLD: f32 = 0.001;

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
    let before = textureLoad(layer_before, vec2<u32>(in.clip.xy), 0).x;
    if in.depth <= before + LAYER_GAP_WORLD || !is_there(in.uv, in.mask) {
        discard;
    }
    return in.depth;
}
