//! Triangles of a node's mesh.

use super::accessor::Buffers;
use super::instances;
use super::materials::Layout;
use super::nodes::{Placed, name_of};
use crate::model::{Model, Object};
use glam::{DVec2, DVec3, Vec2};
use gltf::Document;
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::{Mode, Primitive, Semantic};

/// Adds an object per primitive and instance, in world space. A mirroring transform turns triangles
/// inside out; they are turned back. Both sides are seen, whatever `doubleSided` says.
pub(super) fn add(
    model: &mut Model,
    placed: &Placed,
    (document, buffers): (&Document, &Buffers),
    layouts: &[Option<Layout>],
) -> Result<(), String> {
    let Some(mesh) = placed.node.mesh() else { return Ok(()) };
    let name = name_of(&placed.node, mesh.name());
    let places = instances::places(placed, (document, buffers));
    let places = places.map_err(|message| format!("object '{name}': {message}"))?;
    for primitive in mesh.primitives() {
        let failed = |message: String| format!("object '{name}': {message}");
        let positions = primitive.get(&Semantic::Positions).ok_or("it has no positions".to_owned());
        let positions = positions.map_err(failed)?;
        if positions.data_type() != DataType::F32 {
            return Err(failed(format!("positions are {:?}, not F32", positions.data_type())));
        }
        let numbers = buffers.numbers(&positions, Dimensions::Vec3).map_err(failed)?;
        let vertices = numbers.len() / 3;
        let Some(triangles) = triangles(&primitive, vertices, buffers).map_err(failed)? else {
            model.notes.push(format!("a part of object '{name}' is points or lines and is left out"));
            continue;
        };
        let default = model.materials.len() - 1;
        let material = primitive.material().index().unwrap_or(default);
        let uvs = match &layouts[material] {
            Some(layout) => uvs(&primitive, layout, (&triangles, buffers)).map_err(failed)?,
            None => Vec::new(),
        };
        if layouts[material].is_some() && uvs.is_empty() {
            // Of a cut-out it is an error: `Model::check`.
            model
                .notes
                .push(format!("object '{name}' has a texture but no place in it: its first texel is used"));
        }
        for world_from_mesh in &places {
            let place = |p: &[f64]| world_from_mesh.transform_point3(DVec3::new(p[0], p[1], p[2]));
            let positions = numbers.chunks_exact(3).map(place).collect();
            let (mut triangles, mut uvs) = (triangles.clone(), uvs.clone());
            if world_from_mesh.matrix3.determinant() < 0.0 {
                triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
                uvs.iter_mut().for_each(|uvs| uvs.swap(1, 2));
            }
            let material = material as u32;
            model.objects.push(Object { name: name.clone(), positions, triangles, uvs, material });
        }
    }
    Ok(())
}

/// Per triangle; none where the mesh has no such set of coordinates.
fn uvs(
    primitive: &Primitive,
    layout: &Layout,
    (triangles, buffers): (&[[u32; 3]], &Buffers),
) -> Result<Vec<[Vec2; 3]>, String> {
    let Some(accessor) = primitive.get(&Semantic::TexCoords(layout.set)) else { return Ok(Vec::new()) };
    let numbers = buffers.numbers(&accessor, Dimensions::Vec2)?;
    let places = numbers.chunks_exact(2).map(|uv| layout.place(DVec2::new(uv[0], uv[1])).as_vec2());
    let places: Vec<Vec2> = places.collect();
    // A vertex that does not exist is found out with its position.
    let corner = |v: u32| places.get(v as usize).copied().filter(|uv| uv.is_finite()).unwrap_or_default();
    Ok(triangles.iter().map(|triangle| triangle.map(corner)).collect())
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
