// Slot `pattern`: interleaved gradient noise with y times 4, for checkerboards (first seed
// document, listing 7), 0 to 1, seeded.
fn interleaved_gradient_noise(place: vec2<f32>) -> f32 {
    return fract(52.9829189 * fract(dot(place, vec2(0.06711056, 0.00583715))));
}

fn pattern(place: vec2<f32>, position: vec3<f32>) -> f32 {
    let centre = floor(place) + 0.5;
    let tall = (centre + pattern_shift()) * vec2(1.0, 4.0);
    return fract(interleaved_gradient_noise(tall) + pattern_phase(centre));
}
