// Slot `law`: the second seed document's point light, as printed: a search of 1.5 times the light's
// angle, kernels in metres at the receiver, here as tangents.
fn search_radius_uv(receiver: f32) -> f32 {
    return 1.5 * globals.light_size / max(receiver, 1e-5);
}

fn kernel_radius_uv(receiver: f32, blocker: f32) -> f32 {
    return max(receiver - blocker, 0.0) * globals.light_size / ((blocker + 1e-5) * receiver);
}

// A disc of the light's own radius at the receiver.
fn fixed_radius_uv(receiver: f32) -> f32 {
    return globals.light_size / receiver;
}
