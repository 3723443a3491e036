// The volume between a group of receivers and the light (scanlines/volume.rs).

// Planes turned inwards, w their offset. A plane of zeros holds everything.
var<private> plane_0: vec4<f32>;
var<private> plane_1: vec4<f32>;
var<private> plane_2: vec4<f32>;
var<private> plane_3: vec4<f32>;
var<private> plane_4: vec4<f32>;
var<private> low: vec3<f32>;
var<private> high: vec3<f32>;
// How much lower the planes are for boxes: no box is left out of which a triangle is not.
var<private> loose: f32;

fn side(axis: vec3<f32>, at: vec3<f32>, along: vec3<f32>) -> vec4<f32> {
    let n = cross(at, along);
    let length2 = dot(n, n);
    if !(length2 > 0.0) {
        return vec4<f32>(0.0);
    }
    let unit = n * inverseSqrt(length2);
    let height = dot(unit, axis);
    if abs(height) <= 1e-4 * length(axis) {
        return vec4<f32>(0.0);
    }
    return vec4<f32>(unit * sign(height), 1.0);
}

fn set_sides(middle: vec3<f32>) {
    if KIND == SUN {
        plane_0 = task.sides[0];
        plane_1 = task.sides[1];
        plane_2 = task.sides[2];
        plane_3 = task.sides[3];
        return;
    }
    let axis = task.centre - middle;
    var u = task.u;
    var v = task.v;
    if KIND == SPHERE {
        let far = length(axis);
        let s = task.radius / far;
        if s > 0.95 {
            return;
        }
        let pair = orthonormal_pair(axis / far);
        let width = 1.0001 * far * s / sqrt(1.0 - s * s);
        u = pair[0] * width;
        v = pair[1] * width;
    }
    plane_0 = side(axis, axis + u, v);
    plane_1 = side(axis, axis - u, v);
    plane_2 = side(axis, axis + v, u);
    plane_3 = side(axis, axis - v, u);
}

// Around a flat light that some receivers see from its back, or edge-on: two planes along it, two across the way there.
fn set_slab(middle: vec3<f32>) {
    let upright = normalize(task.axis);
    let across = cross(upright, task.centre - middle);
    let length2 = dot(across, across);
    let unit = across * inverseSqrt(max(length2, 1e-30));
    let some = select(0.0, 1.0, length2 > 1e-30);
    plane_0 = vec4<f32>(upright, 1.0);
    plane_1 = vec4<f32>(-upright, 1.0);
    plane_2 = vec4<f32>(unit * some, some);
    plane_3 = vec4<f32>(-unit * some, some);
}

// The light's lowest height over a plane. A sun's sides are the same from everywhere.
fn lowest_of_light(n: vec3<f32>) -> f32 {
    if KIND == SUN {
        return 3e38;
    }
    if KIND == SPHERE {
        return dot(n, task.centre) - task.radius;
    }
    let a = min(dot(n, task.corners[0].xyz), dot(n, task.corners[1].xyz));
    return min(a, min(dot(n, task.corners[2].xyz), dot(n, task.corners[3].xyz)));
}

// How low the receivers and the light stand over a plane; w is 0 where there is none.
fn offset(plane: vec4<f32>, receivers: f32, slack: f32) -> f32 {
    return select(min(receivers, lowest_of_light(plane.xyz)) - slack, -1.0, plane.w == 0.0);
}

fn touches(box_low: vec3<f32>, box_high: vec3<f32>) -> bool {
    if any(box_low > high) || any(box_high < low) {
        return false;
    }
    let centre = 0.5 * (box_low + box_high);
    let half = 0.5 * (box_high - box_low);
    return reaches(plane_0, centre, half) && reaches(plane_1, centre, half) && reaches(plane_2, centre, half)
        && reaches(plane_3, centre, half) && reaches(plane_4, centre, half);
}

fn reaches(plane: vec4<f32>, centre: vec3<f32>, half: vec3<f32>) -> bool {
    return dot(plane.xyz, centre) + dot(abs(plane.xyz), half) >= plane.w - loose;
}

fn misses(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> bool {
    return any(min(a, min(b, c)) > high) || any(max(a, max(b, c)) < low)
        || below(plane_0, a, b, c) || below(plane_1, a, b, c) || below(plane_2, a, b, c)
        || below(plane_3, a, b, c) || below(plane_4, a, b, c);
}

fn below(plane: vec4<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> bool {
    return max(dot(plane.xyz, a), max(dot(plane.xyz, b), dot(plane.xyz, c))) < plane.w;
}
