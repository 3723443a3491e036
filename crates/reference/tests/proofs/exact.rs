//! Closed forms of visibility and irradiance (GROUND_TRUTH, section 4), in f64.

use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Share of a unit disk on the near side of a line at signed distance `h` from its centre; the
/// centre is on the near side when `h` is positive.
pub(crate) fn disk_cut_by_line(h: f64) -> f64 {
    let h = h.clamp(-1.0, 1.0);
    0.5 + (h * (1.0 - h * h).sqrt() + h.asin()) / PI
}

/// Solid angle common to two spherical caps of angular radii `al` and `be`, their axes `ga` apart.
/// An infinite straight edge is a cap of pi/2.
pub(crate) fn cap_overlap(al: f64, be: f64, ga: f64) -> f64 {
    if ga >= al + be {
        return 0.0;
    }
    if ga <= (al - be).abs() {
        return cap(al.min(be));
    }
    let angle = |x: f64| x.clamp(-1.0, 1.0).acos();
    let ([sa, ca], [sb, cb], [sg, cg]) = ([al.sin(), al.cos()], [be.sin(), be.cos()], [ga.sin(), ga.cos()]);
    2.0 * (PI
        - angle((cg - ca * cb) / (sa * sb))
        - ca * angle((cb - cg * ca) / (sg * sa))
        - cb * angle((ca - cg * cb) / (sg * sb)))
}

/// Solid angle of a cap: not `1 - cos`, which cancels for a small sun.
pub(crate) fn cap(al: f64) -> f64 {
    4.0 * PI * (0.5 * al).sin().powi(2)
}

/// Share of a cap light of radius `al` that a cap occluder leaves.
pub(crate) fn cap_visible(al: f64, be: f64, ga: f64) -> f64 {
    1.0 - cap_overlap(al, be, ga) / cap(al)
}

/// The part of a convex polygon where `normal.x >= offset` (Sutherland and Hodgman 1974).
pub(crate) fn clip(polygon: &[DVec3], normal: DVec3, offset: f64) -> Vec<DVec3> {
    let mut kept = vec![];
    for (i, &a) in polygon.iter().enumerate() {
        let b = polygon[(i + 1) % polygon.len()];
        let (fa, fb) = (normal.dot(a) - offset, normal.dot(b) - offset);
        if fa >= 0.0 {
            kept.push(a);
        }
        if (fa >= 0.0) != (fb >= 0.0) {
            kept.push(a + (b - a) * (fa / (fa - fb)));
        }
    }
    kept
}

/// Area of a polygon in a horizontal plane.
pub(crate) fn area(polygon: &[DVec3]) -> f64 {
    let flat: Vec<DVec2> = polygon.iter().map(|p| DVec2::new(p.x, p.z)).collect();
    let twice: f64 = (0..flat.len()).map(|i| flat[i].perp_dot(flat[(i + 1) % flat.len()])).sum();
    0.5 * twice.abs()
}

/// Irradiance at `p` from a polygon of radiance 1, clipped at the horizon (Lambert 1760).
pub(crate) fn lambert(p: DVec3, normal: DVec3, polygon: &[DVec3]) -> f64 {
    let relative: Vec<DVec3> = polygon.iter().map(|&v| v - p).collect();
    let seen: Vec<DVec3> = clip(&relative, normal, 0.0).into_iter().map(DVec3::normalize).collect();
    let edge = |i: usize| {
        let (a, b) = (seen[i], seen[(i + 1) % seen.len()]);
        let cross = a.cross(b);
        let sine = cross.length();
        if sine < 1e-14 { 0.0 } else { sine.atan2(a.dot(b)) * normal.dot(cross) / sine }
    };
    0.5 * (0..seen.len()).map(edge).sum::<f64>().abs()
}

/// (E, E0) at `p` from a convex polygon light behind a convex polygon strictly between them.
pub(crate) fn shadowed(p: DVec3, normal: DVec3, light: &[DVec3], blocker: &[DVec3]) -> [f64; 2] {
    let whole = lambert(p, normal, light);
    let middle = blocker.iter().sum::<DVec3>() / blocker.len() as f64 - p;
    let mut hidden: Vec<DVec3> = light.iter().map(|&v| v - p).collect();
    for i in 0..blocker.len() {
        let plane = (blocker[i] - p).cross(blocker[(i + 1) % blocker.len()] - p);
        hidden = clip(&hidden, plane * plane.dot(middle).signum(), 0.0);
    }
    let hidden: Vec<DVec3> = hidden.into_iter().map(|v| v + p).collect();
    let lost = if hidden.len() < 3 { 0.0 } else { lambert(p, normal, &hidden) };
    [whole - lost, whole]
}

/// Irradiance below a horizontal disk of radius `r`, `h` below and `a` beside its centre.
pub(crate) fn parallel_disk(r: f64, h: f64, a: f64) -> f64 {
    let k = h * h + a * a;
    0.5 * PI * (1.0 - (k - r * r) / ((k + r * r).powi(2) - 4.0 * a * a * r * r).sqrt())
}

#[test]
fn references_agree_with_each_other() {
    // A half-plane through a disk's centre, a cap's axis: half is left.
    assert_eq!(disk_cut_by_line(0.0), 0.5);
    assert!((cap_visible(0.1, PI / 2.0, PI / 2.0) - 0.5).abs() < 1e-12);
    // For a small cap the straight edge is the disk's: curvature enters with al^2.
    let flat = disk_cut_by_line(0.3);
    assert!((cap_visible(0.001, PI / 2.0, PI / 2.0 + 0.0003) - flat).abs() < 1e-6);
    // A large square above is a half space of directions: pi.
    let square =
        [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(x, z)| DVec3::new(x * 1e4, 1.0, z * 1e4));
    assert!((lambert(DVec3::ZERO, DVec3::Y, &square) - PI).abs() < 1e-6);
    assert_eq!(area(&square), 4e8);
}
