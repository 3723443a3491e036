// Slot `penumbra_shape`: the width at the blocker's plane (excerpt of Real-Time Rendering: divided by the receiver's
// depth).
fn penumbra_shape(receiver: f32, blocker: f32) -> f32 {
    return max(receiver - blocker, 0.0) / receiver;
}
