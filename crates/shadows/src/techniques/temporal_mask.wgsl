// A full-resolution penumbra mask of which each frame computes one pixel of every 2x2 (T16): the
// others keep what the last frames left there, wherever the camera has moved since. Kernel radius in
// map widths; 0 where nothing blocks or nothing is seen.
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

// Search radius over filter radius.
override SEARCH_SCALE: f32;
// Levels of the stored value over the largest radius; 0 keeps floats.
override MASK_LEVELS: f32;

// The pixel of a quad that belongs to each frame of the cycle: diagonals first.
const CYCLE = array<vec2<u32>, 4>(vec2(0u, 0u), vec2(1u, 1u), vec2(1u, 0u), vec2(0u, 1u));

@compute @workgroup_size(8, 8)
fn temporal_mask(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = 2u * id.xy + CYCLE[globals.frame_index & 3u];
    if any(pixel >= globals.frame_size) {
        return;
    }
    let r = surface_at(pixel);
    var radius = 0.0;
    if r.seen {
        let s = shadow_point(r.position, r.normal);
        let largest = search_radius_uv(s.depth);
        let angle = TAU * pattern(r.place, r.position);
        // In the order in which the threads of `penumbra_mask` share the taps, so that both masks are
        // the same to the bit.
        var tally = vec2(0.0);
        for (var share = 0u; share < 4u; share++) {
            tally += tally_part(s, SEARCH_SCALE * largest, turn_of(angle), share, 4u);
        }
        if tally.y > 0.0 {
            radius = kernel_radius_uv(s.depth, tally.x / tally.y);
        }
        if MASK_LEVELS > 0.0 {
            let stored = round(radius / max(largest, 1e-20) * MASK_LEVELS);
            radius = stored / MASK_LEVELS * largest;
        }
    }
    textureStore(destination, pixel, vec4(radius, 0.0, 0.0, 0.0));
}
