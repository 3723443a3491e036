// A row of the blocker search at every pixel: sum of the blockers' depths, and how many they are.
@group(0) @binding(7) var destination: texture_storage_2d<rg32float, write>;

override SEARCH_SCALE: f32;

@compute @workgroup_size(8, 8)
fn sssm_search(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= globals.frame_size) {
        return;
    }
    let r = surface_at(id.xy);
    var tally = vec2(0.0);
    if r.seen {
        let s = shadow_point(r.position, r.normal);
        let half = SEARCH_SCALE * search_radius_uv(s.depth);
        for (var k = 0u; k < GRID_SIDE; k++) {
            let pair = nearest_pair(s, vec2(grid_offset(k, half), 0.0));
            tally += select(vec2(0.0), vec2(pair.x, 1.0), pair.x < pair.y);
        }
    }
    textureStore(destination, id.xy, vec4(tally, 0.0, 0.0));
}
