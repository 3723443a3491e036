// Slot `pattern`: a hash of the world position (second seed document, `hash13`; after Hoskins's
// "hash without sine"), 0 to 1, seeded.
fn hash13(position: vec3<f32>) -> f32 {
    var p = fract(position * 0.1031);
    p += dot(p, p.yzx + 33.33);
    return fract((p.x + p.y) * p.z);
}

fn pattern(place: vec2<f32>, position: vec3<f32>) -> f32 {
    return fract(hash13(position) + pattern_phase(floor(place) + 0.5));
}
