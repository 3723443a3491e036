// What a blur in screen space starts from, per pixel: the hard shadow (one bilinear comparison) and
// the radius of the penumbra's kernel as the camera sees it, in pixels, at most MAX_PIXELS. The
// kernel is taken to face the camera: it knows no foreshortening.
@group(0) @binding(7) var destination: texture_storage_2d<rg32float, write>;

override SEARCH_SCALE: f32;
override MAX_PIXELS: f32;
// 1: places in the map are slopes, which widen with depth (a light that has a place).
override MAP_WIDENS: u32;

fn radius_in_pixels(s: ShadowPoint, radius_uv: f32, depth: f32) -> f32 {
    let map_width = select(1.0, s.depth, MAP_WIDENS == 1u) / globals.map_scale;
    let pixels_per_metre = 0.5 * f32(globals.frame_size.y) / (globals.half_extent.y * depth);
    return min(radius_uv * map_width * pixels_per_metre, MAX_PIXELS);
}

@compute @workgroup_size(8, 8)
fn screen_penumbra(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= globals.frame_size) {
        return;
    }
    let r = surface_at(id.xy);
    var lit = 1.0;
    var radius = 0.0;
    if r.seen {
        let s = shadow_point(r.position, r.normal);
        let angle = TAU * pattern(r.place, r.position);
        lit = lit_bilinear(s, vec2(0.0));
        let blocker = mean_blocker(s, SEARCH_SCALE * search_radius_uv(s.depth), angle);
        if blocker >= 0.0 {
            let depth = textureLoad(camera_depth, id.xy, 0).x;
            radius = radius_in_pixels(s, kernel_radius_uv(s.depth, blocker), depth);
        }
    }
    textureStore(destination, id.xy, vec4(lit, radius, 0.0, 0.0));
}
