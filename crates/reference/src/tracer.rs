//! A scene made ready for tracing.

use crate::{ReferenceError, surfaces::Surfaces};
use glam::Vec3;
use umbrage_scene::{Geometry, Scene};

/// The surfaces of a scene in a tree, with what the path tracer needs of their materials. Holds
/// copies: the scene may be dropped.
pub struct Tracer {
    pub(crate) surfaces: Surfaces,
    /// Per triangle of the scene.
    pub(crate) material: Vec<u32>,
    /// Per material.
    pub(crate) albedo: Vec<Vec3>,
    /// Of what the truth follows from: vertices and triangles, in order.
    pub(crate) geometry_hash: [u8; 32],
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
            geometry_hash: geometry_hash(&scene.geometry),
        })
    }
}

fn geometry_hash(geometry: &Geometry) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&(geometry.positions.len() as u64).to_le_bytes());
    hasher.update(bytemuck::cast_slice(&geometry.positions));
    hasher.update(bytemuck::cast_slice(&geometry.triangles));
    *hasher.finalize().as_bytes()
}
