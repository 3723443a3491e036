//! Fixed surface points at which a window of frames is scored (METRICS: anchors, not pixels).

use crate::{Gbuffer, View};
use glam::Vec3;

/// Surface points, fixed while the camera moves: those that truth's camera rays hit through the
/// pixel centres of the window's middle frame.
#[derive(Clone, Debug)]
pub struct Anchors {
    /// The middle frame.
    pub view: View,
    /// Index (row order) of each anchor's pixel in the middle frame, ascending.
    pub pixel: Vec<u32>,
    /// World position of each.
    pub position: Vec<Vec3>,
    /// Unit geometric normal of each, turned towards the middle frame's viewer.
    pub normal: Vec<Vec3>,
}

/// How far a rasterised surface may lie from an anchor and still be the same surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgreementLimits {
    /// Largest distance of the anchor from the plane of the rasterised surface, as a fraction of
    /// the linear depth. Admits: f32 depth rounding and reconstruction (about 1e-6 of the depth).
    /// Catches: another surface, a wrong matrix.
    pub plane_per_depth: f32,
    /// Largest angle between the normals. 20 degrees: neighbouring facets of a round column (24
    /// sides: 15 degrees) are one surface, two walls that meet in an edge are not. With 3 degrees a
    /// colonnade loses a third of its points, with 20 a sixth.
    pub normal_radians: f32,
}

impl Default for AgreementLimits {
    fn default() -> Self {
        Self { plane_per_depth: 1e-3, normal_radians: 20f32.to_radians() }
    }
}

/// Which anchors are seen, as the same surface, in a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Agreement {
    /// Per anchor: it projects into the picture, on the same surface.
    pub same: Vec<bool>,
    /// Anchors that project outside the picture.
    pub outside: usize,
    /// Anchors inside the picture, on another surface or on none.
    pub other_surface: usize,
}

impl Anchors {
    /// The anchors of a frame: each of its pixels that hits a surface.
    pub fn of(middle: &Gbuffer) -> Self {
        let pixel: Vec<u32> =
            (0..middle.depth.pixels().len() as u32).filter(|&p| middle.is_hit(p as usize)).collect();
        let pick = |image: &crate::Image<Vec3>| pixel.iter().map(|&p| image.pixels()[p as usize]).collect();
        Self { view: middle.view, position: pick(&middle.position), normal: pick(&middle.normal), pixel }
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.pixel.len()
    }

    /// Whether the middle frame hit nothing.
    pub fn is_empty(&self) -> bool {
        self.pixel.is_empty()
    }

    /// The pixel (index in row order) that each anchor falls into in another view.
    pub fn pixels_in(&self, view: &View) -> Vec<Option<u32>> {
        let index = |px: glam::Vec2| px.y as u32 * view.width + px.x as u32;
        self.position.iter().map(|&p| view.project(p).map(index)).collect()
    }

    /// A plane test of every anchor against the rasterised surface in its pixel: never a depth
    /// difference, because at grazing angles one pixel spans metres.
    pub fn agreement(&self, raster: &Gbuffer, limits: AgreementLimits) -> Agreement {
        let mut agreement = Agreement { same: vec![false; self.len()], outside: 0, other_surface: 0 };
        let cos = limits.normal_radians.cos();
        for (i, pixel) in self.pixels_in(&raster.view).into_iter().enumerate() {
            let Some(pixel) = pixel.map(|p| p as usize) else {
                agreement.outside += 1;
                continue;
            };
            let normal = raster.normal.pixels()[pixel];
            let distance = normal.dot(self.position[i] - raster.position.pixels()[pixel]).abs();
            let limit = limits.plane_per_depth * raster.view.depth(self.position[i]);
            let same = raster.is_hit(pixel) && distance <= limit && normal.dot(self.normal[i]) >= cos;
            agreement.same[i] = same;
            agreement.other_surface += usize::from(!same);
        }
        agreement
    }
}
