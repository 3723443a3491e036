// Metres across the map's axis, at a depth, in map widths.
fn uv_from_metres(metres: f32, depth: f32) -> f32 {
    return metres * globals.map_scale / max(depth, 1e-6);
}

// Radius of the light's disc as seen from a receiver at a depth, as a tangent.
fn light_tangent(depth: f32) -> f32 {
    return globals.light_size / max(depth, 1e-6);
}
