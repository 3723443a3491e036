// Slot `pattern`: the same kernel everywhere.
fn pattern(place: vec2<f32>, position: vec3<f32>) -> f32 {
    return 0.0;
}
