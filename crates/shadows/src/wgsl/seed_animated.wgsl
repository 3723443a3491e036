// Slot `seed`: the pattern moves along from frame to frame, for temporal filters to average
// (Jimenez 2014; the shift is the one that engines ship). Seeds other than 0 turn all of it by one
// angle.
override PATTERN_SALT: u32;

fn pattern_shift() -> vec2<f32> {
    return vec2(5.588238 * f32(globals.pattern_frame % 64u));
}

fn pattern_phase(place: vec2<f32>) -> f32 {
    if globals.pattern_seed == 0u {
        return 0.0;
    }
    return unit_from_hash(pcg(globals.pattern_seed ^ pcg(PATTERN_SALT)));
}
