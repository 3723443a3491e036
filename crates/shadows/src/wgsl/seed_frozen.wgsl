// Slot `seed`: the pattern as it is, the same in every frame (what many games ship).
override PATTERN_SALT: u32;

fn pattern_shift() -> vec2<f32> {
    return vec2(0.0);
}

fn pattern_phase(place: vec2<f32>) -> f32 {
    return 0.0;
}
