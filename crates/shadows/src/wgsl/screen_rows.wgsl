// The first axis of a blur in screen space: along rows, as far as the pixel's own radius, weighted
// by slot `weight` so that other surfaces keep their shadows.
@group(0) @binding(6) var penumbra: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

@compute @workgroup_size(8, 8)
fn screen_rows(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= globals.frame_size) {
        return;
    }
    let r = surface_at(id.xy);
    let pixel = vec2<i32>(id.xy);
    let own = textureLoad(penumbra, pixel, 0).xy;
    // A radius of one pixel reaches no neighbour.
    let radius = max(own.y, 1.0);
    let reach = i32(ceil(radius));
    var sum = vec2(0.0);
    for (var dx = -reach; dx <= reach; dx++) {
        let tap = pixel + vec2(dx, 0);
        if r.seen && in_frame(tap) {
            let share = half_disc(f32(dx) / radius) * weight(r, tap);
            sum += share * vec2(textureLoad(penumbra, tap, 0).x, 1.0);
        }
    }
    let lit = select(own.x, sum.x / sum.y, sum.y > 0.0);
    textureStore(destination, id.xy, vec4(lit, 0.0, 0.0, 0.0));
}
