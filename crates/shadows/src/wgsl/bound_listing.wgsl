// Slot `lit_share`: the fourth seed document's function. Its floor is printed below zero: then it changes
// nothing, for a variance is not that negative, and 0 / 0, which the document leaves to the driver,
// counts as shadow here; the soft comparison lights it. Mended, the floor is above zero.
override VARIANCE_FLOOR: f32;

fn lit_share(m: vec2<f32>, depth: f32) -> f32 {
    let soft = smoothstep(depth - 0.02, depth, m.x);
    let variance = max(m.y - m.x * m.x, VARIANCE_FLOOR);
    let difference = depth - m.x;
    let spread = variance + difference * difference;
    let bound = select(variance / spread, 0.0, spread == 0.0);
    return saturate(max(soft, saturate((bound - 0.2) / (1.0 - 0.2))));
}
