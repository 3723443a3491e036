// How much of a disc of radius 1 lies across one of its axes at a distance from the centre: blurring
// a straight edge along the other axis with it is what blurring with the disc does.
fn half_disc(distance: f32) -> f32 {
    return sqrt(max(0.0, 1.0 - distance * distance));
}
