// Slot `seed`: the pattern as it is, the same in every frame (what many games ship); seeds other
// than 0 turn all of it by one angle.
override PATTERN_SALT: u32;

fn pattern_shift() -> vec2<f32> {
    return vec2(0.0);
}

fn pattern_phase(place: vec2<f32>) -> f32 {
    if globals.pattern_seed == 0u {
        return 0.0;
    }
    return unit_from_hash(pcg(globals.pattern_seed ^ pcg(PATTERN_SALT)));
}
