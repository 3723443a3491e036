// The penumbra mask: kernel radius (map widths) per MASK_STEP x MASK_STEP pixels, from the
// surface at the block's centre pixel; 0 where nothing is seen (first seed document, section 2.2).
// Four threads share a texel's taps: so small a target leaves a GPU idle otherwise.
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override MASK_STEP: u32;
// Search radius over filter radius.
override SEARCH_SCALE: f32;
// Levels of the stored value over the largest radius; 0 keeps floats.
override MASK_LEVELS: f32;
// What is stored where nothing blocks, over the largest radius.
override WITHOUT_BLOCKER: f32;

const SHARES: u32 = 4u;
var<workgroup> tallies: array<vec2<f32>, 256>;

@compute @workgroup_size(8, 8, SHARES)
fn penumbra_mask(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let r = surface_at(min(id.xy * MASK_STEP + MASK_STEP / 2u, globals.frame_size - 1u));
    let s = shadow_point(r.position, r.normal);
    let largest = search_radius_uv(s.depth);
    let turn = turn_of(TAU * pattern(vec2<f32>(id.xy) + 0.5, r.position));
    if r.seen {
        tallies[thread] = tally_part(s, SEARCH_SCALE * largest, turn, id.z, SHARES);
    }
    workgroupBarrier();
    if id.z > 0u || any(id.xy >= textureDimensions(destination)) {
        return;
    }
    var radius = 0.0;
    if r.seen {
        let tally = tallies[thread] + tallies[thread + 64u] + tallies[thread + 128u] + tallies[thread + 192u];
        radius = WITHOUT_BLOCKER * largest;
        if tally.y > 0.0 {
            radius = kernel_radius_uv(s.depth, tally.x / tally.y);
        }
        if MASK_LEVELS > 0.0 {
            let stored = round(radius / max(largest, 1e-20) * MASK_LEVELS);
            radius = stored / MASK_LEVELS * largest;
        }
    }
    textureStore(destination, id.xy, vec4(radius, 0.0, 0.0, 0.0));
}
