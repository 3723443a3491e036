//! What a scene is on the GPU, uploaded once.

use super::prepare::IN_AIR;
use crate::Tracer;
use crate::surfaces::Surfaces;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use umbrage_device::{Device, DeviceError};
use wgpu::BufferUsages as Usage;

/// Pieces of a scene that are told apart: two bits with each corner hold one, two of them fill a word of a glance.
pub(super) const PIECES: u32 = 16;

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

    /// A unit normal and the height of its plane; `None` for a triangle without an area, and beyond the last.
    pub(super) fn get(&self, slot: usize) -> Option<(DVec3, f64)> {
        self.0.get(slot).copied().flatten()
    }

    /// The normal alone.
    pub(super) fn normal(&self, slot: usize) -> Option<DVec3> {
        self.get(slot).map(|p| p.0)
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
        let pieces = pieces(surfaces);
        // With each corner what lies on the side that begins there, and two bits of which piece it is of.
        let corner = |(slot, corners): (usize, &[Vec3; 3])| {
            [0, 1, 2].map(|k| {
                let [x, y, z] = corners[k].to_array().map(f32::to_bits);
                let mate = surfaces.mates.of(slot as u32, k);
                let (other, opposite) = mate.map_or((IN_AIR, false), |mate| (mate.slot, mate.opposite));
                [x, y, z, other << 4 | (pieces[slot] >> (2 * k) & 3) << 1 | u32::from(opposite)]
            })
        };
        let corners: Vec<[u32; 4]> = surfaces.corners.iter().enumerate().flat_map(corner).collect();
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

/// A number for each triangle, below `PIECES`: the same for all that hang together, most often
/// another for what does not.
fn pieces(surfaces: &Surfaces) -> Vec<u32> {
    let mut parents: Vec<u32> = (0..surfaces.corners.len() as u32).collect();
    let root = |parents: &mut [u32], mut i: u32| {
        // Ways are halved (Tarjan and van Leeuwen 1984).
        while parents[i as usize] != i {
            let up = parents[parents[i as usize] as usize];
            parents[i as usize] = up;
            i = up;
        }
        i
    };
    for slot in 0..surfaces.corners.len() as u32 {
        for mate in (0..3).filter_map(|k| surfaces.mates.of(slot, k)) {
            let (a, b) = (root(&mut parents, slot), root(&mut parents, mate.slot));
            parents[a.max(b) as usize] = a.min(b);
        }
    }
    // A root comes before all that hang on it.
    let (mut pieces, mut count) = (vec![0; parents.len()], 0);
    for slot in 0..parents.len() {
        let root = root(&mut parents, slot as u32) as usize;
        if root == slot {
            pieces[slot] = count % PIECES;
            count += 1;
        } else {
            pieces[slot] = pieces[root];
        }
    }
    pieces
}
