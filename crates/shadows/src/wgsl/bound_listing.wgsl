// Slot `lit_share`: the fourth seed document's function as printed, its floor below zero included: it
// changes nothing, for a variance is not that negative. 0 / 0, which the document leaves to the
// driver, counts as shadow; the soft comparison lights it.
fn lit_share(m: vec2<f32>, depth: f32) -> f32 {
    let soft = smoothstep(depth - 0.02, depth, m.x);
    let variance = max(m.y - m.x * m.x, -0.001);
    let difference = depth - m.x;
    let spread = variance + difference * difference;
    let bound = select(variance / spread, 0.0, spread == 0.0);
    return saturate(max(soft, saturate((bound - 0.2) / (1.0 - 0.2))));
}
