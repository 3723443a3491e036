// What a user's file may ask besides the shared fragments. Its signatures are a promise
// (docs/your-technique.md); those of the other fragments it passes on.

// Side of the shadow map in texels.
fn map_texels() -> f32 {
    return MAP_TEXELS;
}

// Depth along the light before which nothing blocks, metres.
fn nearest_blocker_depth() -> f32 {
    return globals.nearest_blocker;
}

// A length in texels of the map, in map widths.
fn uv_from_texels(texels: f32) -> f32 {
    return texels / MAP_TEXELS;
}
