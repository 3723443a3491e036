// Slot `kernel_tap`: the spiral half-way between dithering and random of eight points (Jimenez
// 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare"). Unit radius.
fn kernel_tap(i: u32, count: u32, turn: vec2<f32>) -> vec2<f32> {
    return turned(SPIRAL[i], turn);
}

var<private> SPIRAL: array<vec2<f32>, 8> = array<vec2<f32>, 8>(
    vec2(-0.7071, 0.7071),
    vec2(0.0, -0.875),
    vec2(0.5303, 0.5303),
    vec2(-0.625, 0.0),
    vec2(0.3536, -0.3536),
    vec2(0.0, 0.375),
    vec2(-0.1768, -0.1768),
    vec2(0.125, 0.0),
);
