// An edge as one receiver sees it against the light (scanlines/edges.rs).

struct SeenEdge {
    // a x + b y + c, 0 on the edge.
    line: vec3<f32>,
    // Its ends in the light's coordinates.
    start: vec2<f32>,
    stop: vec2<f32>,
    // What it adds to the number of layers on its right where it runs upwards.
    weight: i32,
    piece: u32,
}

fn in_light(s: Sight, corner: vec3<f32>) -> vec3<f32> {
    let d = (corner - s.place) - s.rest;
    return vec3<f32>(dot(s.x, d), dot(s.y, d), dot(s.z, d));
}

// An edge by its ends and the word of the list.
fn see(s: Sight, start: vec3<f32>, stop: vec3<f32>, word: u32) -> SeenEdge {
    let a = in_light(s, start);
    let b = in_light(s, stop);
    let number = i32(word & 3u);
    let weight = select(number - 2, number - 1, number > 1);
    return SeenEdge(edge(a, b), a.xy / a.z, b.xy / b.z, s.handed * weight, word >> 2u);
}

// Whether it may cross the light.
fn crosses(e: SeenEdge) -> bool {
    let end = 1.0 + MARGIN;
    return reach(e.line) * end >= abs(e.line.z)
        && all(max(e.start, e.stop) >= vec2<f32>(-end)) && all(min(e.start, e.stop) <= vec2<f32>(end));
}

// What it adds to the number of layers at the light's middle, which it passes on the left.
fn before_middle(e: SeenEdge) -> i32 {
    // The middle's row is above one end and not above the other.
    if (e.start.y > 0.0) == (e.stop.y > 0.0) {
        return 0;
    }
    let end = 1.0 + MARGIN;
    let left = (e.line.x * e.line.z > 0.0 && min(e.start.x, e.stop.x) <= end) || max(e.start.x, e.stop.x) < -end;
    return select(0, select(-e.weight, e.weight, e.start.y < e.stop.y), left);
}
