// Slot `penumbra_shape`: the distance alone, for a light without a place (third seed document).
fn penumbra_shape(receiver: f32, blocker: f32) -> f32 {
    return max(receiver - blocker, 0.0);
}
