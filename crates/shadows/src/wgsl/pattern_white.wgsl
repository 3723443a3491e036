// Slot `pattern`: white noise, a number per pixel that knows nothing of its neighbours', 0 to 1,
// seeded.
fn pattern(place: vec2<f32>, position: vec3<f32>) -> f32 {
    let centre = floor(place) + 0.5;
    let pixel = vec2<u32>(centre + pattern_shift());
    return fract(unit_from_hash(pcg(pixel.x ^ pcg(pixel.y ^ 0x9e3779b9u))) + pattern_phase(centre));
}
