// One axis of a symmetric blur of up to seven point taps, clamped at the border.
@group(0) @binding(6) var source: texture_2d<f32>;
@group(0) @binding(7) var destination: texture_storage_2d<r32float, write>;

override AXIS: u32;
override WEIGHT_0: f32;
override WEIGHT_1: f32;
override WEIGHT_2: f32;
override WEIGHT_3: f32;

@compute @workgroup_size(8, 8)
fn blur_axis(@builtin(global_invocation_id) id: vec3<u32>) {
    let size = textureDimensions(source);
    if any(id.xy >= size) {
        return;
    }
    let weights = vec4(WEIGHT_0, WEIGHT_1, WEIGHT_2, WEIGHT_3);
    let step = select(vec2(0, 1), vec2(1, 0), AXIS == 0u);
    let last = vec2<i32>(size) - 1;
    var sum = 0.0;
    for (var k = -3; k <= 3; k++) {
        let weight = weights[abs(k)];
        if weight > 0.0 {
            let pixel = clamp(vec2<i32>(id.xy) + k * step, vec2(0), last);
            sum += weight * textureLoad(source, pixel, 0).x;
        }
    }
    textureStore(destination, id.xy, vec4(sum, 0.0, 0.0, 0.0));
}
