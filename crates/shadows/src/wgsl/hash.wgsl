// PCG as a hash (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3)).
fn pcg(value: u32) -> u32 {
    let state = value * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// 0 to 1, excluding 1.
fn unit_from_hash(hash: u32) -> f32 {
    return f32(hash >> 8u) / 16777216.0;
}
