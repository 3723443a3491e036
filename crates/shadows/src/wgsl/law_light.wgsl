// Slot `law`: kernels as wide as the true light's cone (light-matched).
fn search_radius_uv(receiver: f32) -> f32 {
    return true_radius_uv(receiver, globals.nearest_blocker);
}

fn kernel_radius_uv(receiver: f32, blocker: f32) -> f32 {
    return true_radius_uv(receiver, blocker);
}

// For techniques whose kernel cannot know its blocker.
fn fixed_radius_uv(receiver: f32) -> f32 {
    return true_radius_uv(receiver, max(receiver - globals.reference_gap, globals.nearest_blocker));
}
