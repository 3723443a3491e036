//! Where a node's mesh stands: once, or as often as EXT_mesh_gpu_instancing says.

use super::accessor::Buffers;
use super::nodes::Placed;
use glam::{DAffine3, DQuat, DVec3};
use gltf::Document;
use gltf::accessor::Dimensions;

const EXTENSION: &str = "EXT_mesh_gpu_instancing";

/// Of a node with a mesh: from the mesh to the world, for each copy.
pub(super) fn places(
    placed: &Placed,
    (document, buffers): (&Document, &Buffers),
) -> Result<Vec<DAffine3>, String> {
    let Some(extension) = placed.node.extension_value(EXTENSION) else {
        return Ok(vec![placed.world_from_node]);
    };
    let read = |name: &str, expected: Dimensions| -> Result<Option<Vec<f64>>, String> {
        let Some(index) = extension["attributes"].get(name) else { return Ok(None) };
        let accessor = index.as_u64().and_then(|index| document.accessors().nth(index as usize));
        let accessor = accessor.ok_or_else(|| format!("{name} of {EXTENSION} names no accessor"))?;
        buffers.numbers(&accessor, expected).map(Some)
    };
    let moved = read("TRANSLATION", Dimensions::Vec3)?;
    let turned = read("ROTATION", Dimensions::Vec4)?;
    let scaled = read("SCALE", Dimensions::Vec3)?;
    let counts = [moved.as_ref().map(|v| v.len() / 3), turned.as_ref().map(|v| v.len() / 4)];
    let counts = counts.into_iter().chain([scaled.as_ref().map(|v| v.len() / 3)]).flatten();
    let counts: Vec<usize> = counts.collect();
    let Some(&count) = counts.first() else {
        return Err(format!("{EXTENSION} gives neither TRANSLATION, ROTATION nor SCALE"));
    };
    if counts.iter().any(|&other| other != count) {
        return Err(format!("the attributes of {EXTENSION} differ in number: {counts:?}"));
    }
    let vector = |list: &Option<Vec<f64>>, i: usize, default: DVec3| {
        list.as_ref().map_or(default, |list| DVec3::from_slice(&list[3 * i..]))
    };
    let instance = |i: usize| {
        let turn = turned.as_ref().map_or(DQuat::IDENTITY, |list| DQuat::from_slice(&list[4 * i..]));
        let turn = if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY };
        let (scale, place) = (vector(&scaled, i, DVec3::ONE), vector(&moved, i, DVec3::ZERO));
        placed.world_from_node * DAffine3::from_scale_rotation_translation(scale, turn, place)
    };
    Ok((0..count).map(instance).collect())
}
