// Slot `law`: a shape of the penumbra over the depths of receiver and blocker (slot
// `penumbra_shape`), scaled to fit the document's constants or, at the scene's reference gap, the
// true light.
override LAW_SCALE: f32;
// Search radius in map widths; 0: the light's cone to the nearest geometry.
override LAW_SEARCH_UV: f32;
// Largest kernel over the search radius.
override LAW_CAP: f32;

fn search_radius_uv(receiver: f32) -> f32 {
    if LAW_SEARCH_UV > 0.0 {
        return LAW_SEARCH_UV;
    }
    return true_radius_uv(receiver, globals.nearest_blocker);
}

fn kernel_radius_uv(receiver: f32, blocker: f32) -> f32 {
    return min(LAW_SCALE * penumbra_shape(receiver, blocker), LAW_CAP * search_radius_uv(receiver));
}
