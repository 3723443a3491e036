// Slot `weight`: how far a pixel speaks for a receiver, from the distance of its surface to the
// receiver's plane over the receiver's depth: 1 / (0.001 + ratio). Unlike a difference of depths it
// is 0 for every neighbour on an oblique floor, and does not depend on a unit. 0 where nothing is
// seen.
fn weight(r: Receiver, pixel: vec2<i32>) -> f32 {
    let depth = depth_at(pixel);
    if depth <= 0.0 {
        return 0.0;
    }
    let own = view_depth(r.position);
    let there = unprojected(globals.world_from_camera, globals.half_extent, pixel, depth);
    return 1.0 / (0.001 + abs(dot(r.normal, there - r.position)) / own);
}
