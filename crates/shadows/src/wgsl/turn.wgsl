// A rotation by an angle in radians, and a point turned by it.
fn turn_of(angle: f32) -> vec2<f32> {
    return vec2(cos(angle), sin(angle));
}

fn turned(point: vec2<f32>, turn: vec2<f32>) -> vec2<f32> {
    return vec2(point.x * turn.x - point.y * turn.y, point.x * turn.y + point.y * turn.x);
}
