// Metres across the light's direction, at a depth, in map widths: a sun's map is as wide everywhere.
fn uv_from_metres(metres: f32, depth: f32) -> f32 {
    return metres * globals.map_scale;
}

// Radius of the light's disc as seen from a receiver at a depth, as a tangent.
fn light_tangent(depth: f32) -> f32 {
    return globals.light_size;
}
