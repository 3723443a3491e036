// What is sure of a triangle from all receivers of a group at once (scanlines/facing.rs).

// f32 rounds by 2^-24 each time: what a height of a few dozen operations may be off by, for each metre of what it
// was made of.
const DOUBT = 4e-6;

// The middle of the group's box and half of it; of its normals' box likewise.
var<private> centre: vec3<f32>;
var<private> wide: vec3<f32>;
var<private> normal: vec3<f32>;
var<private> sway: vec3<f32>;
// The lowest and the highest receiver along the normal, from the centre.
var<private> heights: vec2<f32>;
var<private> airborne: bool;
// Towards the light: above `nearest` and below `farthest` is between all receivers and all of it.
var<private> upright: vec3<f32>;
var<private> nearest: f32;
var<private> farthest: f32;

// What a triangle is to a group: nowhere between, to be looked at by itself, the same but perhaps a receiver's own,
// in its plane or below its horizon; otherwise wholly between, and on which side of it all receivers are, 1 or -1.
const OUT = 0;
const ALONE = 2;
const DOUBTFUL = 3;
// Whether all receivers have one normal.
var<private> level: bool;

fn largest(a: f32, b: f32, c: f32) -> f32 {
    return max(a, max(b, c));
}

fn along(n: vec3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(n, a), dot(n, b), dot(n, c));
}

fn side_of(slot: u32) -> i32 {
    let v0 = vertex(3u * slot);
    let v1 = vertex(3u * slot + 1u);
    let v2 = vertex(3u * slot + 2u);
    if misses(v0, v1, v2) {
        return OUT;
    }
    let one = vec3<f32>(1.0);
    let a = v0 - centre;
    let b = v1 - centre;
    let c = v2 - centre;
    let sizes = along(one, abs(a), abs(b), abs(c));
    let rounding = DOUBT * (largest(sizes.x, sizes.y, sizes.z) + dot(one, abs(centre)));
    // Heights over every receiver's horizon.
    let over = along(normal, a, b, c);
    let swayed = along(sway, abs(a), abs(b), abs(c));
    let least = over - swayed;
    let most = over + swayed;
    let swings = dot(sway, wide);
    if largest(most.x, most.y, most.z) + rounding < heights.x - swings {
        return OUT;
    }
    let clear = airborne || heights.y + swings + rounding < largest(least.x, least.y, least.z);
    let depths = along(upright, a, b, c);
    let before = min(depths.x, min(depths.y, depths.z)) - rounding > nearest;
    if !clear {
        return DOUBTFUL;
    }
    if !before {
        return ALONE;
    }
    // The height of the triangle's plane over the centre, times twice its area.
    let p = b - a;
    let q = c - a;
    let x = p.yzx * q.zxy;
    let y = p.zxy * q.yzx;
    let n = x - y;
    let plane = dot(n, a);
    let off = dot(abs(n), wide + rounding) + DOUBT * dot(abs(x) + abs(y), abs(a) + wide);
    if !(off < abs(plane)) {
        return ALONE;
    }
    var nearer = KIND == SUN || largest(depths.x, depths.y, depths.z) + rounding < farthest;
    if FLAT && !nearer {
        // Its plane has all receivers on one side and all of the light on the other.
        let u = abs(dot(task.u, n));
        let v = abs(dot(task.v, n));
        let to = task.centre - centre;
        let beyond = (dot(to, n) - plane) * sign(plane) - u - v;
        nearer = beyond > 4.0 * LIGHT_GAP * (dot(abs(to), abs(n)) + abs(plane) + off + u + v);
    }
    if !nearer {
        return ALONE;
    }
    return select(1, -1, plane < 0.0);
}
