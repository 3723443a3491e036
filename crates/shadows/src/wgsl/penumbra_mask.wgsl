// The penumbra mask: kernel radius (map widths) per MASK_STEP x MASK_STEP pixels, from the
// surface at the block's centre pixel; 0 where nothing is seen (first seed
// document, section 2.2).
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override MASK_STEP: u32;
// Search radius over filter radius.
override SEARCH_SCALE: f32;
// Levels of the stored value over the largest radius; 0 keeps floats.
override MASK_LEVELS: f32;
// What is stored where nothing blocks, over the largest radius.
override WITHOUT_BLOCKER: f32;

@compute @workgroup_size(8, 8)
fn penumbra_mask(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(destination)) {
        return;
    }
    let r = surface_at(min(id.xy * MASK_STEP + MASK_STEP / 2u, globals.frame_size - 1u));
    var radius = 0.0;
    if r.seen {
        let s = shadow_point(r.position, r.normal);
        let angle = TAU * pattern(vec2<f32>(id.xy) + 0.5, r.position);
        let largest = search_radius_uv(s.depth);
        let blocker = mean_blocker(s, SEARCH_SCALE * largest, angle);
        radius = WITHOUT_BLOCKER * largest;
        if blocker >= 0.0 {
            radius = kernel_radius_uv(s.depth, blocker);
        }
        if MASK_LEVELS > 0.0 {
            let stored = round(radius / max(largest, 1e-20) * MASK_LEVELS);
            radius = stored / MASK_LEVELS * largest;
        }
    }
    textureStore(destination, id.xy, vec4(radius, 0.0, 0.0, 0.0));
}
