//! Which surfaces a map holds: those over a sun's square, and the least depth of any inside a local
//! light's pyramid.

use glam::{Mat4, Vec2, Vec3, Vec3Swizzles as _, Vec4};
use umbrage_scene::Geometry;

/// The triangles (world space) whose bounding rectangle in light space overlaps a sun's map of this
/// half-width in metres: all that the map can see, and a few more.
pub(crate) fn over_square(
    geometry: &Geometry,
    light_from_world: Mat4,
    half: f32,
) -> impl Iterator<Item = [Vec3; 3]> {
    let all = (0..geometry.triangles.len()).map(|triangle| geometry.corners(triangle));
    all.filter(move |corners| {
        let [a, b, c] = corners.map(|p| light_from_world.transform_point3(p).xy());
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        low.cmple(Vec2::splat(half)).all() && high.cmpge(Vec2::splat(-half)).all()
    })
}

/// Least and largest distance of any surface from a point, in metres. The least is that of a point
/// inside a triangle, not of a corner.
pub(crate) fn distances(geometry: &Geometry, from: Vec3) -> (f32, f32) {
    let all = (0..geometry.triangles.len()).map(|triangle| geometry.corners(triangle));
    all.fold((f32::INFINITY, 0f32), |(near, far), corners| {
        let [a, b, c] = corners.map(|p| p - from);
        let farthest = a.length().max(b.length()).max(c.length());
        (near.min(distance_to_triangle(a, b, c)), far.max(farthest))
    })
}

/// Distance from the origin to a triangle: to its plane where the foot lies inside, otherwise to the
/// nearest edge.
fn distance_to_triangle(a: Vec3, b: Vec3, c: Vec3) -> f32 {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let inside = |from: Vec3, to: Vec3| normal.dot((to - from).cross(-from)) >= 0.0;
    if normal != Vec3::ZERO && inside(a, b) && inside(b, c) && inside(c, a) {
        return normal.dot(a).abs();
    }
    let to_edge = |from: Vec3, to: Vec3| {
        let along = to - from;
        let part = (-from.dot(along) / along.length_squared().max(1e-30)).clamp(0.0, 1.0);
        (from + along * part).length()
    };
    to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
}

/// The pyramid that a map sees, in light space.
pub(crate) struct Pyramid {
    /// A point is inside where the product with each is not negative: the near plane, four sides.
    planes: [Vec4; 5],
}

impl Pyramid {
    /// `scale` in map widths per unit of slope, `near` in metres.
    pub(crate) fn new(scale: f32, near: f32) -> Self {
        let side = |x: f32, y: f32| Vec4::new(x * scale, y * scale, -0.5, 0.0);
        let near = Vec4::new(0.0, 0.0, -1.0, -near);
        Self { planes: [near, side(1.0, 0.0), side(-1.0, 0.0), side(0.0, 1.0), side(0.0, -1.0)] }
    }

    /// Smallest depth inside (`None` where nothing is inside), and largest depth of any vertex. A
    /// wall may cross the map without a vertex in it, so triangles are clipped.
    pub(crate) fn depths(&self, geometry: &Geometry, light_from_world: Mat4) -> (Option<f32>, f32) {
        let mut range = (None::<f32>, 0f32);
        for triangle in 0..geometry.triangles.len() {
            let corners = geometry.corners(triangle).map(|p| light_from_world.transform_point3(p));
            range.1 = corners.iter().fold(range.1, |far, p| far.max(-p.z));
            let visible = self.planes.iter().fold(corners.to_vec(), |shape, plane| clipped(shape, *plane));
            let nearest = visible.iter().map(|p| -p.z).reduce(f32::min);
            range.0 = range.0.into_iter().chain(nearest).reduce(f32::min);
        }
        range
    }
}

/// The part of a convex polygon on the inner side of a plane (Sutherland and Hodgman 1974).
fn clipped(shape: Vec<Vec3>, plane: Vec4) -> Vec<Vec3> {
    let side = |p: Vec3| plane.dot(p.extend(1.0));
    // Most triangles are not cut.
    if shape.iter().all(|&p| side(p) >= 0.0) {
        return shape;
    }
    let mut inner = Vec::with_capacity(shape.len() + 1);
    for (k, &a) in shape.iter().enumerate() {
        let b = shape[(k + 1) % shape.len()];
        let (at_a, at_b) = (side(a), side(b));
        if at_a >= 0.0 {
            inner.push(a);
        }
        if (at_a >= 0.0) != (at_b >= 0.0) {
            inner.push(a.lerp(b, at_a / (at_a - at_b)));
        }
    }
    inner
}
