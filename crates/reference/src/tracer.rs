//! A scene made ready for tracing.

use crate::{ReferenceError, surfaces::Surfaces};
use umbrage_scene::Scene;

/// The surfaces of a scene in a tree, with what the path tracer needs of their materials. Holds
/// copies: the scene may be dropped.
pub struct Tracer {
    pub(crate) surfaces: Surfaces,
    /// Per triangle of the scene.
    pub(crate) material: Vec<u32>,
}

impl Tracer {
    /// Builds the tree.
    ///
    /// # Errors
    /// When the scene has no triangles, too many, a vertex that is not finite, or an index that
    /// names nothing.
    pub fn new(scene: &Scene) -> Result<Self, ReferenceError> {
        Ok(Self { surfaces: Surfaces::new(scene)?, material: scene.geometry.material.clone() })
    }
}
