// Slot `penumbra_shape`: similar triangles (Fernando 2005; first seed document, listing 5).
fn penumbra_shape(receiver: f32, blocker: f32) -> f32 {
    return max(receiver - blocker, 0.0) / blocker;
}
