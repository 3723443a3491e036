//! What a scene is on the GPU, uploaded once.

use crate::Tracer;
use glam::DVec3;
use rayon::prelude::*;
use umbrage_device::{Device, DeviceError};
use wgpu::BufferUsages as Usage;

/// Every triangle's plane in f64.
pub(super) struct Planes(Vec<Option<(DVec3, f64)>>);

/// What is uploaded once.
pub(super) struct Scene {
    pub(super) nodes: wgpu::Buffer,
    pub(super) corners: wgpu::Buffer,
    pub(super) planes: wgpu::Buffer,
    /// The pair of nodes to begin with.
    pub(super) root: u32,
}

impl Planes {
    pub(super) fn new(tracer: &Tracer) -> Self {
        let surfaces = &tracer.surfaces;
        let of = |slot: usize| {
            let [a, b, c] = surfaces.corners_f64(slot as u32);
            let normal = (b - a).cross(c - a).try_normalize()?;
            Some((normal, normal.dot(a)))
        };
        Self((0..surfaces.corners.len()).into_par_iter().map(of).collect())
    }

    /// A unit normal; `None` for a triangle without an area, and beyond the last.
    pub(super) fn normal(&self, slot: usize) -> Option<DVec3> {
        self.0.get(slot).copied().flatten().map(|p| p.0)
    }
}

impl Scene {
    pub(super) fn new(tracer: &Tracer, planes: &Planes, device: &Device) -> Result<Self, DeviceError> {
        let surfaces = &tracer.surfaces;
        let node = |node: &obvhs::bvh2::node::Bvh2Node| {
            let bounds = node.aabb();
            let [min, max] = [bounds.min, bounds.max].map(|v| v.to_array().map(f32::to_bits));
            [min[0], min[1], min[2], node.prim_count, max[0], max[1], max[2], node.first_index]
        };
        let mut nodes: Vec<[u32; 8]> = surfaces.bvh.nodes.iter().map(node).collect();
        // Nodes are taken in pairs: the root gets a sister that nothing touches.
        let root = nodes.len() as u32;
        let [far, near] = [3.4e38f32, -3.4e38].map(f32::to_bits);
        nodes.extend([nodes[0], [far, far, far, 1, near, near, near, 0]]);
        let corners: Vec<[f32; 4]> =
            surfaces.corners.iter().flatten().map(|c| c.extend(0.0).to_array()).collect();
        let plane = |plane: &Option<(DVec3, f64)>| {
            let (normal, offset) = plane.unwrap_or_default();
            let whole = normal.extend(offset);
            let high = whole.as_vec4();
            [high.to_array(), (whole - high.as_dvec4()).as_vec4().to_array()]
        };
        let planes: Vec<[f32; 4]> = planes.0.iter().flat_map(plane).collect();
        Ok(Self {
            nodes: device.upload("nodes", bytemuck::cast_slice(&nodes), Usage::STORAGE)?,
            corners: device.upload("corners", bytemuck::cast_slice(&corners), Usage::STORAGE)?,
            planes: device.upload("planes", bytemuck::cast_slice(&planes), Usage::STORAGE)?,
            root,
        })
    }
}
