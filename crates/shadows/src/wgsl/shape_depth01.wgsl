// Slot `penumbra_shape`: similar triangles in depths that count from the near plane (second seed document, directional
// light). The near plane is fitted to the nearest geometry, as engines fit it: softness then depends on
// where that is..
fn penumbra_shape(receiver: f32, blocker: f32) -> f32 {
    let near = globals.nearest_blocker * 0.999;
    let range = globals.far - near;
    return max(receiver - blocker, 0.0) / range / max((blocker - near) / range, 1e-6);
}
