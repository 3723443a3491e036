// A triangle as one receiver sees it against the light, and the lines that its edges are
// (scanlines/blocks.rs, outline.rs).

const SMALLEST = 1.17549435e-38;

struct Seen {
    some: bool,
    whole: bool,
    // Not wholly nearer than the light.
    straddles: bool,
    // a x + b y + c, not negative inside.
    edges: array<vec3<f32>, 3>,
    // Corners in the light's axes.
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
    volume: f32,
}

// It negates exactly when the ends change places: nothing leaks between neighbours.
fn edge(start: vec3<f32>, end: vec3<f32>) -> vec3<f32> {
    return cross(0.5 * (start + end), end - start);
}

fn reach(e: vec3<f32>) -> f32 {
    if ROUND {
        return sqrt(e.x * e.x + e.y * e.y);
    }
    return abs(e.x) + abs(e.y);
}

fn corners_of(slot: u32) -> mat3x3<f32> {
    return mat3x3<f32>(corners[3u * slot].xyz, corners[3u * slot + 1u].xyz, corners[3u * slot + 2u].xyz);
}

fn survey(s: Sight, slot: u32, triangle: mat3x3<f32>) -> Seen {
    var seen: Seen;
    let corner_a = triangle[0];
    let corner_b = triangle[1];
    let corner_c = triangle[2];
    let da = (corner_a - s.place) - s.rest;
    let db = (corner_b - s.place) - s.rest;
    let dc = (corner_c - s.place) - s.rest;
    let a = vec3<f32>(dot(s.x, da), dot(s.y, da), dot(s.z, da));
    let b = vec3<f32>(dot(s.x, db), dot(s.y, db), dot(s.z, db));
    let c = vec3<f32>(dot(s.x, dc), dot(s.y, dc), dot(s.z, dc));
    let farthest = max(a.z, max(b.z, c.z));
    let nearest = min(a.z, min(b.z, c.z));
    if !(farthest > 0.0 && nearest < s.far) {
        return seen;
    }
    // Off the light on one side: X, -X, Y or -Y is larger than Z at every corner.
    let depths = vec3<f32>(a.z, b.z, c.z) * (1.0 + MARGIN);
    let xs = vec3<f32>(a.x, b.x, c.x);
    let ys = vec3<f32>(a.y, b.y, c.y);
    if all(xs > depths) || all(-xs > depths) || all(ys > depths) || all(-ys > depths) {
        return seen;
    }
    var e0 = edge(b, c);
    var e1 = edge(c, a);
    var e2 = edge(a, b);
    let volume = dot(a, e0);
    if volume < 0.0 {
        e0 = -e0;
        e1 = -e1;
        e2 = -e2;
    }
    seen.volume = abs(volume);
    if !(seen.volume > 0.0) {
        return seen;
    }
    // An edge's least and largest value on the light.
    let reaches = vec3<f32>(reach(e0), reach(e1), reach(e2));
    let middles = vec3<f32>(e0.z, e1.z, e2.z);
    let least = middles - reaches;
    let most = middles + reaches;
    let smallest = min(least.x, min(least.y, least.z));
    var largest = min(most.x, min(most.y, most.z));
    var before = farthest < s.near;
    if FLAT {
        let plane = e0 + e1 + e2;
        let excess = plane.z - seen.volume / s.near;
        let around = reach(plane);
        largest = min(largest, excess + around);
        before = before || excess - around > 0.0;
    }
    if largest < 0.0 {
        return seen;
    }
    // A corner surely above the horizon: f32 rounds eight times by 2^-24 of the coordinates.
    let heights = vec3<f32>(dot(s.normal, da), dot(s.normal, db), dot(s.normal, dc));
    let errors = vec3<f32>(dot(abs(da), vec3<f32>(1.0)), dot(abs(db), vec3<f32>(1.0)), dot(abs(dc), vec3<f32>(1.0)));
    let clear = any(heights > 2e-6 * (vec3<f32>(s.extent) + errors));
    if !clear && s.slot != IN_AIR {
        if s.slot == slot || !(rises(s, corner_a) || rises(s, corner_b) || rises(s, corner_c)) {
            return seen;
        }
    }
    seen.some = true;
    seen.whole = before && smallest >= 0.0;
    seen.straddles = !before;
    seen.edges = array<vec3<f32>, 3>(e0, e1, e2);
    seen.a = a;
    seen.b = b;
    seen.c = c;
    return seen;
}

// Whether a corner is above the receiver's plane (receiver.rs).
fn rises(s: Sight, corner: vec3<f32>) -> bool {
    let rounding = COPLANAR * dot(abs(s.normal), max(abs(corner), abs(s.place)));
    let over = height(s.slot, corner);
    return select(over, -over, s.back) > rounding;
}

// x = slope y + at in the rows' coordinates, and whether the inside is to the right.
struct Line {
    slope: f32,
    at: f32,
    left: bool,
}

fn line_of(turn: vec4<f32>, e: vec3<f32>) -> Line {
    let x = e.x * turn.x + e.y * turn.z;
    let y = e.x * turn.y + e.y * turn.w;
    // An edge along the rows becomes one that all but is.
    let wide = max(abs(x), 1e-12 * (abs(y) + abs(e.z)) + SMALLEST);
    let per = select(-1.0, 1.0, (bitcast<u32>(x) >> 31u) != 0u) / wide;
    return Line(y * per, e.z * per, per < 0.0);
}

// The rows that may be touched: the first, and the one after the last.
fn rows_of(s: Sight, seen: Seen, turn: vec4<f32>) -> vec2<u32> {
    let depths = vec3<f32>(seen.a.z, seen.b.z, seen.c.z);
    let xs = vec3<f32>(seen.a.x, seen.b.x, seen.c.x);
    let ys = vec3<f32>(seen.a.y, seen.b.y, seen.c.y);
    let nearest = min(depths.x, min(depths.y, depths.z));
    let farthest = max(depths.x, max(depths.y, depths.z));
    if !(nearest > 1e-6 * farthest) {
        return vec2<u32>(0u, ALL_ROWS);
    }
    let at = (turn.w * ys - turn.z * xs) / depths;
    var low = min(at.x, min(at.y, at.z));
    var high = max(at.x, max(at.y, at.z));
    if CONE {
        low = min(low, low * s.cone.w);
        high = max(high, high * s.cone.w);
    }
    let half = 0.5 * f32(BASE_ROWS);
    let middle = half + f32(ALL_ROWS - BASE_ROWS) * 0.5;
    // Row j of a replicate stands between j and j + 1.
    let first = low * half + (middle - 1.0 - MARGIN * half);
    let last = high * half + (middle + 1.0 + MARGIN * half);
    let span = floor(clamp(vec2<f32>(first, last), vec2<f32>(0.0), vec2<f32>(255.0)));
    return min(vec2<u32>(span), vec2<u32>(ALL_ROWS));
}
