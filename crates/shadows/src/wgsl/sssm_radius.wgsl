// The kernel's half-length at every pixel, from a column of the search's rows; 0 without a blocker.
@group(0) @binding(6) var rows: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override SEARCH_SCALE: f32;

@compute @workgroup_size(8, 8)
fn sssm_radius(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= globals.frame_size) {
        return;
    }
    let r = surface_at(id.xy);
    var radius = 0.0;
    if r.seen {
        let depth = shadow_point(r.position, r.normal).depth;
        let half = SEARCH_SCALE * search_radius_uv(depth);
        var tally = vec2(0.0);
        for (var k = 0u; k < GRID_SIDE; k++) {
            let n = neighbour(r, grid_offset(k, half));
            if n.found {
                tally += textureLoad(rows, n.pixel, 0).xy;
            }
        }
        if tally.y > 0.0 {
            radius = kernel_radius_uv(depth, tally.x / tally.y);
        }
    }
    textureStore(destination, id.xy, vec4(radius, 0.0, 0.0, 0.0));
}
