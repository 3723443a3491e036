// A symmetric separable blur of up to seven point taps an axis, clamped at the border: each
// workgroup loads its texels and three round them once, blurs rows, then columns.
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override WEIGHT_0: f32;
override WEIGHT_1: f32;
override WEIGHT_2: f32;
override WEIGHT_3: f32;

// 8 texels and 3 on each side.
const SIDE: u32 = 14u;
var<workgroup> loaded: array<f32, 196>;
var<workgroup> rows: array<f32, 112>;

fn weighted(m3: f32, m2: f32, m1: f32, middle: f32, p1: f32, p2: f32, p3: f32) -> f32 {
    return WEIGHT_3 * m3 + WEIGHT_2 * m2 + WEIGHT_1 * m1 + WEIGHT_0 * middle + WEIGHT_1 * p1 + WEIGHT_2 * p2
        + WEIGHT_3 * p3;
}

@compute @workgroup_size(8, 8)
fn blur_tile(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) thread: u32,
) {
    let size = textureDimensions(source);
    let last = vec2<i32>(size) - 1;
    let corner = vec2<i32>(group.xy * 8u) - 3;
    for (var k = thread; k < SIDE * SIDE; k += 64u) {
        let texel = clamp(corner + vec2<i32>(vec2(k % SIDE, k / SIDE)), vec2(0), last);
        loaded[k] = textureLoad(source, texel, 0).x;
    }
    workgroupBarrier();
    for (var k = thread; k < 8u * SIDE; k += 64u) {
        let at = k / 8u * SIDE + k % 8u;
        rows[k] = weighted(loaded[at], loaded[at + 1u], loaded[at + 2u], loaded[at + 3u], loaded[at + 4u], loaded[at + 5u], loaded[at + 6u]);
    }
    workgroupBarrier();
    let at = thread;
    let sum = weighted(rows[at], rows[at + 8u], rows[at + 16u], rows[at + 24u], rows[at + 32u], rows[at + 40u], rows[at + 48u]);
    if all(id.xy < size) {
        textureStore(destination, id.xy, vec4(sum, 0.0, 0.0, 0.0));
    }
}
