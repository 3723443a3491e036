//! Triangles of a node's mesh.

use super::accessor::Buffers;
use super::nodes::{Placed, name_of};
use crate::model::{Model, Object};
use glam::DVec3;
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::{Mode, Primitive, Semantic};

/// Adds an object per primitive, in world space. A mirroring transform turns triangles inside out;
/// they are turned back.
pub(super) fn add(model: &mut Model, placed: &Placed, buffers: &Buffers) -> Result<(), String> {
    let Some(mesh) = placed.node.mesh() else { return Ok(()) };
    let name = name_of(&placed.node, mesh.name());
    let mirrored = placed.world_from_node.matrix3.determinant() < 0.0;
    for primitive in mesh.primitives() {
        let failed = |message: String| format!("object '{name}': {message}");
        let positions = primitive.get(&Semantic::Positions).ok_or("it has no positions".to_owned());
        let positions = positions.map_err(failed)?;
        if positions.data_type() != DataType::F32 {
            return Err(failed(format!("positions are {:?}, not F32", positions.data_type())));
        }
        let numbers = buffers.numbers(&positions, Dimensions::Vec3).map_err(failed)?;
        let place = |p: &[f64]| placed.world_from_node.transform_point3(DVec3::new(p[0], p[1], p[2]));
        let positions: Vec<DVec3> = numbers.chunks_exact(3).map(place).collect();
        let Some(mut triangles) = triangles(&primitive, positions.len(), buffers).map_err(failed)? else {
            model.notes.push(format!("a part of object '{name}' is points or lines and is left out"));
            continue;
        };
        if mirrored {
            triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        let default = model.materials.len() - 1;
        let material = primitive.material().index().unwrap_or(default) as u32;
        model.objects.push(Object { name: name.clone(), positions, triangles, material });
    }
    Ok(())
}

/// `None` for points and lines.
fn triangles(
    primitive: &Primitive,
    vertices: usize,
    buffers: &Buffers,
) -> Result<Option<Vec<[u32; 3]>>, String> {
    let indices = match primitive.indices() {
        Some(accessor) => buffers.indices(&accessor)?,
        None => (0..vertices as u32).collect(),
    };
    Ok(match primitive.mode() {
        Mode::Triangles => Some(indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect()),
        Mode::TriangleStrip => Some(strip(&indices)),
        Mode::TriangleFan => {
            Some(indices.get(1..).unwrap_or_default().windows(2).map(|w| [indices[0], w[0], w[1]]).collect())
        }
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => None,
    })
}

/// Every other triangle is turned, so that all face the same way.
fn strip(indices: &[u32]) -> Vec<[u32; 3]> {
    let turned = |(i, w): (usize, &[u32])| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
    indices.windows(3).enumerate().map(turned).collect()
}
