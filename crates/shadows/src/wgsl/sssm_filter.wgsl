// A row of the filter at every pixel, as long as its own kernel.
@group(0) @binding(6) var radii: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

@compute @workgroup_size(8, 8)
fn sssm_filter(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= globals.frame_size) {
        return;
    }
    let r = surface_at(id.xy);
    var lit = 1.0;
    if r.seen {
        let s = shadow_point(r.position, r.normal);
        let half = textureLoad(radii, id.xy, 0).x;
        var sum = 0.0;
        for (var k = 0u; k < GRID_SIDE; k++) {
            sum += lit_bilinear(s, vec2(grid_offset(k, half), 0.0));
        }
        lit = sum / f32(GRID_SIDE);
    }
    textureStore(destination, id.xy, vec4(lit, 0.0, 0.0, 0.0));
}
