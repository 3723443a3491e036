// Slot `law`: the first seed document's artistic law (listing 4), as printed.
override FILTER_RADIUS_UV: f32;

fn search_radius_uv(receiver: f32) -> f32 {
    return FILTER_RADIUS_UV;
}

fn kernel_radius_uv(receiver: f32, blocker: f32) -> f32 {
    let ratio = (receiver - blocker) / blocker;
    return FILTER_RADIUS_UV * saturate(80.0 * ratio * ratio);
}

fn fixed_radius_uv(receiver: f32) -> f32 {
    return FILTER_RADIUS_UV;
}
