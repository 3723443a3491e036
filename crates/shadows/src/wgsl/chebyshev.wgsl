// Chebyshev's bound on the share of a distribution that lies at or beyond a depth (Donnelly and
// Lauritzen 2006; third seed document), 1 where the mean does.
override MIN_VARIANCE: f32;

fn upper_bound(m: vec2<f32>, depth: f32) -> f32 {
    let variance = max(m.y - m.x * m.x, MIN_VARIANCE);
    let difference = depth - m.x;
    return select(variance / (variance + difference * difference), 1.0, difference < 0.0);
}
