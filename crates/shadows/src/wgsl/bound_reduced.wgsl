// Slot `lit_share`: the bound, from BLEEDING on stretched to 0..1 (fourth seed document's `linstep`
// against light bleeding; 0 leaves the bound as it is).
override BLEEDING: f32;

fn lit_share(m: vec2<f32>, depth: f32) -> f32 {
    return saturate((upper_bound(m, depth) - BLEEDING) / (1.0 - BLEEDING));
}
