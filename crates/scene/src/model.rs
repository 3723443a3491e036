//! What loaders and generators hand over: named objects in the file's own coordinates, in f64, not
//! yet checked. No light, no path and no region: those come from the scene file.

use crate::gltf_file::CameraTrack;
use crate::{AlphaMask, Material, SceneError};
use glam::{DAffine3, DVec3, Vec2};
use std::path::Path;

/// A model as it was read or generated.
#[derive(Clone, Debug, Default)]
pub(crate) struct Model {
    pub(crate) objects: Vec<Object>,
    pub(crate) materials: Vec<Material>,
    pub(crate) cameras: Vec<ModelCamera>,
    pub(crate) notes: Vec<String>,
}

/// A run of triangles of one material under one name.
#[derive(Clone, Debug)]
pub(crate) struct Object {
    pub(crate) name: String,
    pub(crate) positions: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Per triangle, where its corners stand in the material's pictures; empty without any.
    pub(crate) uvs: Vec<[Vec2; 3]>,
    pub(crate) material: u32,
}

/// A camera of the model's file.
#[derive(Clone, Debug)]
pub(crate) struct ModelCamera {
    pub(crate) name: String,
    pub(crate) yfov_radians: f64,
    pub(crate) track: CameraTrack,
}

impl Model {
    /// Moves everything.
    pub(crate) fn transform(&mut self, world_from_file: DAffine3) {
        for position in self.objects.iter_mut().flat_map(|object| &mut object.positions) {
            *position = world_from_file.transform_point3(*position);
        }
        for camera in &mut self.cameras {
            camera.track.world_from_file = world_from_file * camera.track.world_from_file;
        }
    }

    /// Whether every triangle has its vertices, and each of them a place that f32 can hold.
    ///
    /// # Errors
    /// `IndexOutOfRange` or `VertexNotFinite` for the first that has not; a cut-out without places in its picture,
    /// which would be there or not as the picture's first texel happens to be.
    pub(crate) fn check(&self, path: &Path) -> Result<(), SceneError> {
        self.objects.iter().try_for_each(|object| object.check(path))?;
        let is_cut = |object: &&Object| {
            let material = self.materials.get(object.material as usize);
            material.and_then(|m| m.mask.as_ref()).is_some_and(AlphaMask::varies)
        };
        match self.objects.iter().filter(is_cut).find(|o| o.uvs.len() < o.triangles.len()) {
            None => Ok(()),
            Some(object) => Err(SceneError::value(
                path,
                format!(
                    "object '{}' is cut out by a picture, but has no texture coordinates (OBJ vt, glTF TEXCOORD): export them, or \
                     make its material opaque",
                    object.name
                ),
            )),
        }
    }

    /// Takes over another file's contents.
    pub(crate) fn append(&mut self, mut other: Self) {
        let first = self.materials.len() as u32;
        other.objects.iter_mut().for_each(|object| object.material += first);
        self.objects.append(&mut other.objects);
        self.materials.append(&mut other.materials);
        self.cameras.append(&mut other.cameras);
        self.notes.append(&mut other.notes);
    }

    /// Smallest and largest coordinates of vertices that a triangle uses; `None` without any. To be
    /// asked of a checked model.
    pub(crate) fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let used = self.objects.iter().flat_map(|object| {
            object.triangles.iter().flatten().map(|&vertex| object.positions[vertex as usize])
        });
        used.fold(None, |bounds, p| match bounds {
            None => Some((p, p)),
            Some((lo, hi)) => Some((lo.min(p), hi.max(p))),
        })
    }
}

impl Object {
    fn check(&self, path: &Path) -> Result<(), SceneError> {
        let vertices = self.positions.len();
        for (triangle, &vertex) in
            self.triangles.iter().enumerate().flat_map(|(t, all)| all.iter().map(move |v| (t, v)))
        {
            let Some(&position) = self.positions.get(vertex as usize) else {
                let (path, object) = (path.to_owned(), self.name.clone());
                return Err(SceneError::IndexOutOfRange { path, object, triangle, vertex, vertices });
            };
            if !position.as_vec3().is_finite() {
                let (path, object, vertex) = (path.to_owned(), self.name.clone(), vertex as usize);
                return Err(SceneError::VertexNotFinite { path, object, vertex, position });
            }
        }
        Ok(())
    }
}
