//! A few rays against all triangles: enough to find a floor, a free view, or that something lies
//! inside a solid. No acceleration structure: thousands of rays would be the wrong tool here.

use crate::Geometry;
use crate::model::Model;
use glam::DVec3;

/// Triangles without order.
pub(crate) struct Soup(Vec<[DVec3; 3]>);

/// The nearest surface along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hit {
    /// In lengths of the ray's direction.
    pub(crate) distance: f64,
    /// Whether the triangle was met from the side from which it is counter-clockwise.
    pub(crate) front: bool,
}

/// Six directions, none along an axis, so that no ray runs along the edges of boxes.
const AROUND: [DVec3; 6] = [
    DVec3::new(1.0, 0.0217, 0.0131),
    DVec3::new(-1.0, 0.0113, -0.0271),
    DVec3::new(0.0177, 1.0, 0.0239),
    DVec3::new(-0.0251, -1.0, 0.0103),
    DVec3::new(0.0137, -0.0229, 1.0),
    DVec3::new(-0.0193, 0.0149, -1.0),
];

impl From<&Model> for Soup {
    /// Of a checked model.
    fn from(model: &Model) -> Self {
        let corners = model.objects.iter().flat_map(|object| {
            object.triangles.iter().map(|triangle| triangle.map(|v| object.positions[v as usize]))
        });
        Self(corners.collect())
    }
}

impl From<&Geometry> for Soup {
    fn from(geometry: &Geometry) -> Self {
        let corners = |t: usize| geometry.corners(t).map(|corner| corner.as_dvec3());
        Self((0..geometry.triangles.len()).map(corners).collect())
    }
}

impl Soup {
    pub(crate) fn cast(&self, from: DVec3, direction: DVec3) -> Option<Hit> {
        let hits = self.0.iter().filter_map(|corners| intersect(*corners, from, direction));
        hits.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }

    /// Whether a point lies inside a solid: all round it, the nearest surfaces show their backs. A
    /// room whose walls face inwards, or one that is open anywhere in these directions, is none.
    pub(crate) fn is_inside_solid(&self, point: DVec3) -> bool {
        AROUND.iter().all(|&direction| self.cast(point, direction).is_some_and(|hit| !hit.front))
    }
}

/// Moeller and Trumbore (1997), in f64.
fn intersect([a, b, c]: [DVec3; 3], from: DVec3, direction: DVec3) -> Option<Hit> {
    let (ab, ac, offset) = (b - a, c - a, from - a);
    let across = direction.cross(ac);
    let determinant = ab.dot(across);
    let (q, inverse) = (offset.cross(ab), 1.0 / determinant);
    let (u, v, distance) = (offset.dot(across) * inverse, direction.dot(q) * inverse, ac.dot(q) * inverse);
    // Written so that NaN (a ray in the triangle's plane) is a miss.
    let hit = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0;
    hit.then_some(Hit { distance, front: determinant > 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    #[test]
    fn tells_solids_from_rooms_and_open_air() {
        let scene = Scene::builtin("stacked-blockers").expect("a scene");
        let mut geometry = scene.geometry;
        let soup = Soup::from(&geometry);
        let in_floor = DVec3::new(1.0, -0.1, 2.0);
        assert!(soup.is_inside_solid(in_floor));
        assert!(!soup.is_inside_solid(DVec3::new(1.0, 0.5, -2.0)));
        geometry.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        assert!(!Soup::from(&geometry).is_inside_solid(in_floor), "walls that face inwards make a room");
    }

    #[test]
    fn hits_the_nearest_face_and_knows_its_side() {
        let triangle = |z: f64| [DVec3::new(0.0, 0.0, z), DVec3::new(1.0, 0.0, z), DVec3::new(0.0, 1.0, z)];
        let soup = Soup(vec![triangle(3.0), triangle(2.0)]);
        let from = DVec3::new(0.25, 0.25, 0.0);
        assert_eq!(soup.cast(from, DVec3::Z), Some(Hit { distance: 2.0, front: false }));
        let beyond = DVec3::new(0.25, 0.25, 5.0);
        assert_eq!(soup.cast(beyond, DVec3::NEG_Z), Some(Hit { distance: 2.0, front: true }));
        assert_eq!(soup.cast(from, DVec3::NEG_Z), None);
        assert_eq!(soup.cast(from, DVec3::X), None, "a ray beside the plane");
    }
}
