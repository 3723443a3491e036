//! A scene made ready for tracing.

use crate::{ReferenceError, surfaces::Surfaces};
use glam::{DVec3, Vec2};
use umbrage_scene::{Material, Scene, uv_at};

/// The surfaces of a scene in a tree, with what the path tracer needs of their materials. Holds
/// copies: the scene may be dropped.
pub struct Tracer {
    pub(crate) surfaces: Surfaces,
    /// Per triangle of the scene.
    pub(crate) material: Vec<u32>,
    materials: Vec<Material>,
    /// Per triangle of the scene, or none.
    uvs: Vec<[Vec2; 3]>,
    /// `Scene::content_hash`.
    pub(crate) scene_hash: [u8; 32],
}

impl Tracer {
    /// Builds the tree.
    ///
    /// # Errors
    /// When the scene has no triangles, too many, a vertex that is not finite, or an index that
    /// names nothing.
    pub fn new(scene: &Scene) -> Result<Self, ReferenceError> {
        let surfaces = Surfaces::new(scene)?;
        Ok(Self {
            surfaces,
            material: scene.geometry.material.clone(),
            materials: scene.materials.clone(),
            uvs: scene.geometry.uvs.clone(),
            scene_hash: scene.content_hash(),
        })
    }

    /// Whether any surface is cut out.
    pub fn has_masks(&self) -> bool {
        self.surfaces.cutouts.is_some()
    }

    /// Linear reflectance at a place on a triangle.
    pub(crate) fn albedo(&self, slot: u32, place: DVec3) -> DVec3 {
        let triangle = self.surfaces.triangle_of_slot[slot as usize] as usize;
        let material = &self.materials[self.material[triangle] as usize];
        let albedo = match self.uvs.get(triangle) {
            Some(uvs) => material.albedo_at(uv_at((&self.surfaces.corners_f64(slot), uvs), place)),
            None => material.albedo,
        };
        albedo.as_dvec3()
    }
}
