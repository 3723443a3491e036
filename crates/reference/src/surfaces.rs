//! Triangles in a tree, and the two ray queries.
//!
//! `Bvh2`, never `CwBvh`: the latter loses every ray with a `-0.0` direction component and every
//! occluder nearer than 1e-4. Boxes are tested by obvhs in f32, triangles here in f64.

use crate::ReferenceError;
use crate::cutouts::Cutouts;
use crate::mates::Mates;
use glam::{DVec3, Vec3, Vec3A};
use obvhs::{BvhBuildParams, bvh2::Bvh2, bvh2::builder::build_bvh2_from_tris, ray::Ray, triangle::Triangle};
use umbrage_scene::Scene;

/// obvhs prunes boxes in f32 (six roundings of 2^-24 a slab): a ray's end is put this much farther
/// for boxes, so that only the f64 triangle test decides.
pub(crate) const BOX_END: f64 = 1.0 + 1e-6;

/// All triangles of a scene in the order of a tree's leaves.
pub(crate) struct Surfaces {
    pub(crate) bvh: Bvh2,
    /// Corners, in leaf order ("slots").
    pub(crate) corners: Vec<[Vec3; 3]>,
    /// Slot to triangle of the scene.
    pub(crate) triangle_of_slot: Vec<u32>,
    /// Triangle of the scene to slot.
    slot_of_triangle: Vec<u32>,
    /// In slots.
    pub(crate) mates: Mates,
    /// Those that are not there everywhere; `None` where all are.
    pub(crate) cutouts: Option<Cutouts>,
    /// Largest absolute coordinate, metres.
    pub(crate) extent: f32,
}

/// A half-line, or a part of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) origin: DVec3,
    /// Unit length.
    pub(crate) direction: DVec3,
    /// Distances from the origin between which a surface counts.
    pub(crate) range: [f64; 2],
}

/// The closest surface on a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) slot: u32,
    pub(crate) distance: f64,
}

impl Surfaces {
    pub(crate) fn new(scene: &Scene) -> Result<Self, ReferenceError> {
        check(scene)?;
        let geometry = &scene.geometry;
        let triangles: Vec<Triangle> = (0..geometry.triangles.len())
            .map(|t| geometry.corners(t).map(Vec3A::from))
            .map(|[v0, v1, v2]| Triangle { v0, v1, v2 })
            .collect();
        let mut bvh = build(&triangles);
        let triangle_of_slot = std::mem::take(&mut bvh.primitive_indices);
        let mut slot_of_triangle = vec![0; triangles.len()];
        for (slot, &triangle) in triangle_of_slot.iter().enumerate() {
            slot_of_triangle[triangle as usize] = slot as u32;
        }
        let corners = triangle_of_slot.iter().map(|&t| geometry.corners(t as usize)).collect();
        let in_slots: Vec<[u32; 3]> =
            triangle_of_slot.iter().map(|&t| geometry.triangles[t as usize]).collect();
        let mates = Mates::new(&geometry.positions, &in_slots);
        let (low, high) = geometry.bounds();
        let extent = low.abs().max(high.abs()).max_element();
        let cutouts = Cutouts::new(scene, &triangle_of_slot);
        Ok(Self { bvh, corners, triangle_of_slot, slot_of_triangle, mates, cutouts, extent })
    }

    /// Where a triangle of the scene stands; `None` for `u32::MAX` and other strangers.
    pub(crate) fn slot(&self, triangle: u32) -> Option<u32> {
        self.slot_of_triangle.get(triangle as usize).copied()
    }

    /// The corners of a slot in f64.
    pub(crate) fn corners_f64(&self, slot: u32) -> [DVec3; 3] {
        self.corners[slot as usize].map(Vec3::as_dvec3)
    }

    /// Whether a triangle is cut out.
    pub(crate) fn is_cut(&self, slot: u32) -> bool {
        self.cutouts.as_ref().is_some_and(|cutouts| cutouts.has(slot))
    }

    /// Whether a triangle is there, so far along its sides.
    pub(crate) fn is_there(&self, slot: u32, along: [f64; 2]) -> bool {
        self.cutouts.as_ref().is_none_or(|cutouts| cutouts.is_there(slot, along))
    }

    /// The nearest surface on a line but for the skipped ones.
    pub(crate) fn closest(&self, line: &Line, skip: impl Fn(u32, &[Vec3; 3]) -> bool) -> Option<Hit> {
        let mut best: Option<Hit> = None;
        let mut end = line.range[1];
        self.bvh.ray_traverse(line.boxes(), &mut obvhs::ray::RayHit::none(), |_, slot| {
            match intersect(line, self.corners_f64(slot as u32)) {
                Some((distance, along))
                    if distance >= line.range[0]
                        && distance < end
                        && !skip(slot as u32, &self.corners[slot])
                        && self.is_there(slot as u32, along) =>
                {
                    end = distance;
                    best = Some(Hit { slot: slot as u32, distance });
                    (distance * BOX_END) as f32
                }
                _ => f32::INFINITY,
            }
        });
        best
    }

    /// Whether one triangle crosses a line.
    pub(crate) fn crosses(&self, line: &Line, slot: u32) -> bool {
        intersect(line, self.corners_f64(slot))
            .is_some_and(|(t, along)| t > line.range[0] && t < line.range[1] && self.is_there(slot, along))
    }

    /// Names every surface that crosses a line.
    pub(crate) fn crossing(&self, line: &Line, mut tell: impl FnMut(u32)) {
        self.bvh.ray_traverse_anyhit(line.boxes(), |_, slot| {
            if self.crosses(line, slot as u32) {
                tell(slot as u32);
            }
        });
    }

    /// Whether any surface but the skipped ones crosses a line.
    pub(crate) fn blocked(&self, line: &Line, skip: impl Fn(u32, &[Vec3; 3]) -> bool) -> bool {
        !self.bvh.ray_traverse_miss(line.boxes(), |_, slot| {
            let hit = self.crosses(line, slot as u32) && !skip(slot as u32, &self.corners[slot]);
            if hit { 0.0 } else { f32::INFINITY }
        })
    }
}

impl Line {
    /// The same line as obvhs sees it. Adding zero turns a direction's -0.0 into +0.0.
    fn boxes(&self) -> Ray {
        let direction = self.direction.as_vec3a() + Vec3A::ZERO;
        Ray::new(self.origin.as_vec3a(), direction, 0.0, (self.range[1] * BOX_END) as f32)
    }
}

/// Distance along a line to a triangle, either side, and how far along the triangle's first and second
/// sides (Möller and Trumbore 1997, in f64).
pub(crate) fn intersect(line: &Line, [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 2])> {
    let (ab, ac) = (b - a, c - a);
    let p = line.direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let s = line.origin - a;
    let q = s.cross(ab);
    let u = s.dot(p) / determinant;
    let v = line.direction.dot(q) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| (ac.dot(q) / determinant, [u, v]))
}

fn build(triangles: &[Triangle]) -> Bvh2 {
    let mut bvh = build_bvh2_from_tris(triangles, BvhBuildParams::medium_build(), &mut Default::default());
    // The builder sizes the traversal stack before it reinserts nodes, and an overflow drops
    // subtrees in silence: measure the depth that came out.
    bvh.max_depth = bvh.max_depth.max(depth(&bvh) + 1);
    bvh
}

/// Nodes on the longest way from the root to a leaf (`Bvh2::depth` recurses, which a degenerate
/// tree could turn into an overflow).
pub(crate) fn depth(bvh: &Bvh2) -> usize {
    let mut deepest = 0;
    let mut open = vec![(0usize, 1usize)];
    while let Some((index, depth)) = open.pop() {
        deepest = deepest.max(depth);
        let node = &bvh.nodes[index];
        if !node.is_leaf() {
            let first = node.first_index as usize;
            open.extend([(first, depth + 1), (first + 1, depth + 1)]);
        }
    }
    deepest
}

fn check(scene: &Scene) -> Result<(), ReferenceError> {
    let geometry = &scene.geometry;
    let count = geometry.triangles.len();
    if count == 0 {
        return Err(ReferenceError::NoTriangles);
    }
    if count > 1 << 31 {
        return Err(ReferenceError::TooManyTriangles(count));
    }
    if let Some(vertex) = geometry.positions.iter().position(|p| !p.is_finite()) {
        return Err(ReferenceError::VertexNotFinite(vertex));
    }
    let beyond = |t: &[u32; 3]| t.iter().any(|&v| v as usize >= geometry.positions.len());
    if let Some(triangle) = geometry.triangles.iter().position(beyond) {
        return Err(ReferenceError::NoSuchVertex(triangle));
    }
    let known = |t: usize| geometry.material.get(t).is_some_and(|&m| (m as usize) < scene.materials.len());
    match (0..count).find(|&t| !known(t)) {
        Some(triangle) => Err(ReferenceError::NoSuchMaterial(triangle)),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree(corners: &[[Vec3; 3]]) -> (Bvh2, Vec<Triangle>) {
        let triangles: Vec<Triangle> =
            corners.iter().map(|t| t.map(Vec3A::from)).map(|[v0, v1, v2]| Triangle { v0, v1, v2 }).collect();
        (build(&triangles), triangles)
    }

    /// Sizes that grow by a constant factor: each triangle joins all the smaller ones.
    #[test]
    fn the_stack_is_as_deep_as_the_tree() {
        let sizes = (0..236).map(|k| 1e-15 * 1.3f32.powi(k));
        let shape = [Vec3::new(1.0, 0.1, 0.0), Vec3::new(-0.5, 0.1, 0.8), Vec3::new(-0.5, 0.1, -0.8)];
        let corners: Vec<[Vec3; 3]> = sizes.map(|s| shape.map(|v| v * s)).collect();
        let (bvh, triangles) = tree(&corners);
        let deepest = depth(&bvh);
        assert!(deepest > 96, "only {deepest}: the pathology is gone, find another");
        assert!(bvh.max_depth > deepest);
        // Panics when a node, a box or the depth is wrong.
        bvh.validate(&triangles, false, false);
    }
}
