// The next layer of what the light sees (depth peeling, Everitt 2001): as `raster_shadow`, but for
// what is no farther than the layer before.
@group(0) @binding(6) var layer_before: texture_2d<f32>;

// A surface is no layer of its own; nor is one that touches it.
const LAYER_GAP_WORLD: f32 = 0.001;

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
    if in.depth <= textureLoad(layer_before, vec2<u32>(in.clip.xy), 0).x + LAYER_GAP_WORLD {
        discard;
    }
    return in.depth;
}
