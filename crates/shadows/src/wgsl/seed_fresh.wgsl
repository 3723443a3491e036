// Slot `seed`: a fresh offset for each frame, seed and 16x16 block of the shaded target (scores):
// estimates over frames and seeds are then unbiased (METRICS, estimators).
override PATTERN_SALT: u32;

fn pattern_shift() -> vec2<f32> {
    return vec2(0.0);
}

fn pattern_phase(place: vec2<f32>) -> f32 {
    let block = vec2<u32>(place) / 16u;
    let run = pcg(globals.pattern_seed ^ pcg(globals.pattern_frame ^ pcg(PATTERN_SALT)));
    return unit_from_hash(pcg(block.x ^ pcg(block.y ^ run)));
}
