// Slot `kernel_tap`: Vogel's disc (first seed document, listing 1). Unit radius.
fn kernel_tap(i: u32, count: u32, angle: f32) -> vec2<f32> {
    let radius = sqrt(f32(i) + 0.5) / sqrt(f32(count));
    let theta = f32(i) * 2.4 + angle;
    return radius * vec2(cos(theta), sin(theta));
}
