// A pass that shades some pixels of the frame into a target of its own. `target_pixel`,
// `target_place` and `shade` are slots. Texels that stand for no pixel are never read.
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

@compute @workgroup_size(8, 8)
fn shade_target(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(destination)) {
        return;
    }
    let pixel = target_pixel(id.xy);
    var lit = 1.0;
    if all(pixel < globals.frame_size) {
        var r = surface_at(pixel);
        r.place = target_place(id.xy);
        if r.seen {
            lit = shade(r);
        }
    }
    textureStore(destination, id.xy, vec4(lit, 0.0, 0.0, 0.0));
}
