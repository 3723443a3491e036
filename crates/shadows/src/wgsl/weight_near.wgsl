// Slot `weight`: how far a pixel speaks for a receiver, from the distance between the surface there
// and the receiver over the receiver's depth: 1 / (0.001 + ratio). On a wall that faces the camera
// all neighbours are alike; on an oblique floor those of the same row are nearer, and of a ledge the
// other side is far. It depends on no unit. 0 where nothing is seen.
fn weight(r: Receiver, pixel: vec2<i32>) -> f32 {
    let depth = depth_at(pixel);
    if depth <= 0.0 {
        return 0.0;
    }
    let eye = globals.world_from_camera[3].xyz;
    let own = view_depth(r.position);
    // The receiver itself where its kept depth puts it.
    let position = eye + (r.position - eye) * (kept_depth(own) / own);
    let there = unprojected(globals.world_from_camera, globals.half_extent, pixel, depth);
    return 1.0 / (0.001 + length(there - position) / own);
}
