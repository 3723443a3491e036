// A triangle as one receiver sees it against the light (scanlines/blocks.rs).

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
    return mat3x3<f32>(vertex(3u * slot), vertex(3u * slot + 1u), vertex(3u * slot + 2u));
}

fn survey(s: Sight, word: u32, triangle: mat3x3<f32>) -> Seen {
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
    var doubtful = false;
    if (word & CLEAR) == 0u && s.slot != IN_AIR {
        // Over the horizon, less what is allowed there (`rises`). Differences of near places are exact: f32 rounds
        // eight times by 2^-24 of them.
        let allowed = vec3<f32>(
            allowed_at(s, corner_a), allowed_at(s, corner_b), allowed_at(s, corner_c),
        );
        let one = vec3<f32>(1.0);
        let errors = 1e-6 * vec3<f32>(dot(abs(da), one), dot(abs(db), one), dot(abs(dc), one));
        let over = vec3<f32>(dot(s.normal, da), dot(s.normal, db), dot(s.normal, dc)) - allowed;
        if all(over < -errors) {
            return seen;
        }
        doubtful = !any(over > errors);
        if s.slot == word {
            return seen;
        }
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
    if doubtful && !(rises(s, corner_a) || rises(s, corner_b) || rises(s, corner_c)) {
        return seen;
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

// How high a corner may be over the receiver's plane and count as in it (receiver.rs).
fn allowed_at(s: Sight, corner: vec3<f32>) -> f32 {
    return COPLANAR * dot(abs(s.normal), max(abs(corner), abs(s.place)));
}

// Whether a corner is above the receiver's plane.
fn rises(s: Sight, corner: vec3<f32>) -> bool {
    let over = height(s.slot, corner);
    return select(over, -over, s.back) > allowed_at(s, corner);
}
