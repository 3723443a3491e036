// Slot `weight`: how far a pixel speaks for a receiver, from the difference of their depths, as in
// the first seed document's demo: 1 / (0.001 + difference). Its light stands 500 of its units from
// the origin: the unit follows the light's distance, as that of its bias does. 0 where nothing is
// seen.
fn weight(r: Receiver, pixel: vec2<i32>) -> f32 {
    let depth = depth_at(pixel);
    if depth <= 0.0 {
        return 0.0;
    }
    let unit = globals.eye_distance / 500.0;
    return 1.0 / (0.001 + abs(depth - kept_depth(view_depth(r.position))) / unit);
}
