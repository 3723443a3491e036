//! A scene made ready for tracing.

use crate::{ReferenceError, surfaces::Surfaces};
use glam::Vec3;
use umbrage_scene::Scene;

/// The surfaces of a scene in a tree, with what the path tracer needs of their materials. Holds
/// copies: the scene may be dropped.
pub struct Tracer {
    pub(crate) surfaces: Surfaces,
    /// Per triangle of the scene.
    pub(crate) material: Vec<u32>,
    /// Per material.
    pub(crate) albedo: Vec<Vec3>,
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
            albedo: scene.materials.iter().map(|m| m.albedo).collect(),
            scene_hash: scene.content_hash(),
        })
    }
}
