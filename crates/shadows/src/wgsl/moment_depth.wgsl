// Depth as moments hold it: linear, a far plane's distance long (fourth seed document), counted from
// the middle between the nearest geometry and the far plane, where squares keep most of their digits.
// A variance does not depend on where one counts from.
fn moment_centre() -> f32 {
    return 0.5 * (globals.nearest_blocker + globals.far);
}

fn moment_depth(depth: f32) -> f32 {
    return (depth - moment_centre()) / globals.far;
}
