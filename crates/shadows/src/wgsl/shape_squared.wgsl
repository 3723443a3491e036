// Slot `penumbra_shape`: the first seed document's law (listing 4).
fn penumbra_shape(receiver: f32, blocker: f32) -> f32 {
    let ratio = (receiver - blocker) / blocker;
    return ratio * ratio;
}
