//! A scene's triangles as the raster passes draw them: those that are whole, and those that are cut out.

use crate::layout::{CutVertex, Vertex};
use glam::Vec3;
use umbrage_scene::{AlphaMask, Scene};

/// Three vertices a triangle, with its geometric normal.
#[derive(Clone, Debug, Default)]
pub(crate) struct Triangles {
    pub(crate) whole: Vec<Vertex>,
    pub(crate) cut: Vec<CutVertex>,
    /// Masks as `cutout.wgsl` reads them.
    pub(crate) masks: Vec<u32>,
}

impl Triangles {
    pub(crate) fn of(scene: &Scene) -> Self {
        let mut triangles = Self::default();
        let mut number = |mask: &AlphaMask| {
            let first = triangles.masks.len() as u32;
            let [u, v] = mask.wrap().map(|wrap| wrap as u32);
            triangles.masks.extend(mask.size().into_iter().chain([u | v << 8]));
            triangles.masks.extend(mask.bits());
            first
        };
        let masks: Vec<Option<u32>> = scene
            .materials
            .iter()
            .map(|material| material.mask.as_ref())
            .map(|m| m.map(&mut number))
            .collect();
        let geometry = &scene.geometry;
        for triangle in 0..geometry.triangles.len() {
            let [a, b, c] = geometry.corners(triangle);
            let normal = (b - a).cross(c - a).normalize_or(Vec3::Y).to_array();
            let corners = [a, b, c].map(|p| p.to_array());
            match masks[geometry.material[triangle] as usize] {
                None => triangles.whole.extend(corners.map(|position| Vertex { position, normal })),
                Some(mask) => {
                    let uvs = geometry.uvs.get(triangle).copied().unwrap_or_default();
                    let vertex = |k: usize| {
                        let (position, uv) = (corners[k], uvs[k].to_array());
                        CutVertex { position, normal, uv, mask }
                    };
                    triangles.cut.extend([0, 1, 2].map(vertex));
                }
            }
        }
        triangles
    }
}
