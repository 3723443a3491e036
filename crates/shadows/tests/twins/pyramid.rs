//! Twin of a local light's nearest depth: the least depth of any triangle inside the map's pyramid.
//!
//! Depth is linear over a triangle, so its least value inside a convex pyramid lies at a corner of
//! the triangle, where an edge meets a side, or where an edge of the pyramid meets the triangle.

use super::approx::{Approx, Approx3};

/// The least depth of these triangles (light space) in a map of this scale.
pub(crate) fn nearest(triangles: &[[Approx3; 3]], scale: Approx) -> Approx {
    let all = triangles.iter().flat_map(|triangle| {
        let mut found: Vec<Approx3> = triangle.to_vec();
        for k in 0..3 {
            found.extend(cuts(triangle[k], triangle[(k + 1) % 3], scale));
        }
        for corner in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]] {
            found.extend(pierced(triangle, corner.map(|c| Approx::exact(0.5 * c) / scale)));
        }
        found
    });
    all.filter(|p| inside(p, scale)).map(|p| -p.0[2]).reduce(Approx::min).expect("the map sees something")
}

fn inside(p: &Approx3, scale: Approx) -> bool {
    let [x, y, z] = p.0.map(|c| c.value);
    // Points that were put on a side count, whatever the rounding.
    z < 0.0 && x.abs().max(y.abs()) * scale.value <= -0.5 * z * (1.0 + 1e-9)
}

/// Where an edge meets the four sides (behind the light too: `inside` sorts those out).
fn cuts(a: Approx3, b: Approx3, scale: Approx) -> Vec<Approx3> {
    let mut found = Vec::new();
    for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
        let beyond = |p: Approx3| Approx::exact(sign) * p.0[axis] * scale + Approx::exact(0.5) * p.0[2];
        let (at_a, at_b) = (beyond(a), beyond(b));
        if at_a.value * at_b.value < 0.0 {
            found.push(a.plus(b.minus(a).times(at_a / (at_a - at_b))));
        }
    }
    found
}

/// Where the ray (x, y, -1) meets a triangle.
fn pierced(triangle: &[Approx3; 3], [x, y]: [Approx; 2]) -> Option<Approx3> {
    let [a, b, c] = *triangle;
    let ray = Approx3([x, y, Approx::exact(-1.0)]);
    let normal = b.minus(a).cross(c.minus(a));
    let facing = normal.dot(ray);
    if facing.value == 0.0 {
        return None;
    }
    let place = ray.times(normal.dot(a) / facing);
    let within =
        |from: Approx3, to: Approx3| normal.dot(to.minus(from).cross(place.minus(from))).value >= 0.0;
    (within(a, b) && within(b, c) && within(c, a)).then_some(place)
}
