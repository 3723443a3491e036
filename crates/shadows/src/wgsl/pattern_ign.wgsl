// Slot `pattern`: interleaved gradient noise (first seed document, listing 2), 0 to 1, seeded.
fn interleaved_gradient_noise(place: vec2<f32>) -> f32 {
    return fract(52.9829189 * fract(dot(place, vec2(0.06711056, 0.00583715))));
}

fn pattern(place: vec2<f32>, position: vec3<f32>) -> f32 {
    let centre = floor(place) + 0.5;
    return fract(interleaved_gradient_noise(centre + pattern_shift()) + pattern_phase(centre));
}
