// One axis of a Gaussian of seven taps whose spacing is inversely proportional to the distance from
// the camera (T12d): a texel at PLAIN_DISTANCE_WORLD, at most two; fetched linearly between texels.
@group(0) @binding(2) var camera_depth: texture_2d<f32>;
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override AXIS: u32;
override MASK_STEP: u32;
override PLAIN_DISTANCE_WORLD: f32;
override WEIGHT_0: f32;
override WEIGHT_1: f32;
override WEIGHT_2: f32;
override WEIGHT_3: f32;

@compute @workgroup_size(8, 8)
fn blur_distance_axis(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(source);
    if any(id.xy >= size) {
        return;
    }
    let pixel = min(id.xy * MASK_STEP + MASK_STEP / 2u, globals.frame_size - 1u);
    let depth = textureLoad(camera_depth, pixel, 0).x;
    let spacing = min(PLAIN_DISTANCE_WORLD / max(depth, 1e-6), 2.0);
    let weights = vec4(WEIGHT_0, WEIGHT_1, WEIGHT_2, WEIGHT_3);
    let step = select(vec2(0, 1), vec2(1, 0), AXIS == 0u);
    let last = vec2<i32>(size) - 1;
    var sum = 0.0;
    for (var k = -3; k <= 3; k++) {
        let place = f32(k) * spacing;
        let below = i32(floor(place));
        let first = clamp(vec2<i32>(id.xy) + below * step, vec2(0), last);
        let second = clamp(vec2<i32>(id.xy) + (below + 1) * step, vec2(0), last);
        let value = mix(textureLoad(source, first, 0).x, textureLoad(source, second, 0).x, place - floor(place));
        sum += weights[abs(k)] * value;
    }
    textureStore(destination, id.xy, vec4(sum, 0.0, 0.0, 0.0));
}
