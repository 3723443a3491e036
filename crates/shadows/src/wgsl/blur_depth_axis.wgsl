// One axis of a Gaussian over mask texels of like depth (T12c): each weight is multiplied by
// exp(-(dz / (LIKE_DEPTH z))^2 / 2), dz between the surfaces at the texels' centres.
@group(0) @binding(2) var camera_depth: texture_2d<f32>;
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override AXIS: u32;
override MASK_STEP: u32;
override LIKE_DEPTH: f32;
override WEIGHT_0: f32;
override WEIGHT_1: f32;
override WEIGHT_2: f32;
override WEIGHT_3: f32;

fn depth_of(texel: vec2<i32>) -> f32 {
    let pixel = vec2<u32>(texel) * MASK_STEP + MASK_STEP / 2u;
    return textureLoad(camera_depth, min(pixel, globals.frame_size - 1u), 0).x;
}

@compute @workgroup_size(8, 8)
fn blur_depth_axis(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(source);
    if any(id.xy >= size) {
        return;
    }
    let weights = vec4(WEIGHT_0, WEIGHT_1, WEIGHT_2, WEIGHT_3);
    let step = select(vec2(0, 1), vec2(1, 0), AXIS == 0u);
    let last = vec2<i32>(size) - 1;
    let depth = depth_of(vec2<i32>(id.xy));
    var sum = 0.0;
    var total = 0.0;
    for (var k = -3; k <= 3; k++) {
        let texel = clamp(vec2<i32>(id.xy) + k * step, vec2(0), last);
        let unlike = (depth_of(texel) - depth) / max(LIKE_DEPTH * depth, 1e-6);
        let weight = weights[abs(k)] * exp(-0.5 * unlike * unlike);
        sum += weight * textureLoad(source, texel, 0).x;
        total += weight;
    }
    textureStore(destination, id.xy, vec4(sum / total, 0.0, 0.0, 0.0));
}
