// Slot `kernel_tap`: Vogel's disc (first seed document, listing 1). Unit radius; `turn` is the
// rotation's cosine and sine. A table of the points is a tenth faster on a GPU, but a software driver
// copies it at every tap, or unrolls every loop that reads it (docs/performance.md).
fn kernel_tap(i: u32, count: u32, turn: vec2<f32>) -> vec2<f32> {
    let radius = sqrt(f32(i) + 0.5) / sqrt(f32(count));
    let theta = f32(i) * 2.4;
    return radius * turned(vec2(cos(theta), sin(theta)), turn);
}
