//! Surfaces per pixel, and the frames that shadows were rendered for.

use crate::{Image, ShadowMask, View};
use glam::Vec3;

/// What is seen at each pixel centre.
#[derive(Clone, Debug)]
pub struct Gbuffer {
    /// From where.
    pub view: View,
    /// Linear depth along the viewing direction in metres; infinite where nothing is hit.
    pub depth: Image<f32>,
    /// World position in metres; zero where nothing is hit.
    pub position: Image<Vec3>,
    /// Unit geometric normal turned towards the viewer; zero where nothing is hit.
    pub normal: Image<Vec3>,
}

impl Gbuffer {
    /// Whether a surface is seen at this pixel (index in row order).
    pub fn is_hit(&self, pixel: usize) -> bool {
        self.depth.pixels()[pixel].is_finite()
    }
}

/// One mask with the surfaces that it belongs to.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The unoccluded fraction of the light.
    pub mask: ShadowMask,
    /// What is seen.
    pub gbuffer: Gbuffer,
}

/// The frames along a path, in order; a still is a sequence of one.
pub type Sequence = Vec<Frame>;
