//! Wavefront OBJ through tobj, with MTL diffuse colours, their pictures, and cut-outs (`map_d`).
//!
//! tobj parses numbers as f32: a vertex 1 km from the file's origin is exact to .03 mm, one 10 km
//! away to .3 mm; recentring cannot bring back more. Polygons become fans from their first vertex,
//! which is right for convex ones only. An object is a run of faces under one `o` or `g` name and
//! one material. Normals are left out before tobj sees them, and texture coordinates where no library
//! names a picture.

mod library;
mod lines;
#[cfg(test)]
mod tests;

use crate::model::{Model, Object};
use crate::{AlphaMask, Material, SceneError};
use glam::{Vec2, Vec3};
use lines::{Counts, Kept, Lines};
use std::cell::RefCell;
use std::path::Path;

/// What tobj is asked to do: fans of triangles, positions shared within an object, no points or
/// lines.
const OPTIONS: tobj::LoadOptions =
    tobj::LoadOptions { single_index: false, triangulate: true, ignore_points: true, ignore_lines: true };

pub(crate) fn read(path: &Path) -> Result<Model, SceneError> {
    let bytes = std::fs::read(path).map_err(|source| SceneError::Read { path: path.to_owned(), source })?;
    parse(&bytes, path)
}

/// `path` is for messages, and its folder for material libraries.
pub(crate) fn parse(bytes: &[u8], path: &Path) -> Result<Model, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let counts = Counts::default();
    let notes = RefCell::new(Vec::new());
    let pictures = lines::libraries(bytes).iter().any(|name| library::has_pictures(&folder.join(name)));
    let kept = if pictures { Kept::Pictures } else { Kept::Positions };
    let loaded = tobj::load_obj_buf(&mut Lines::new(bytes, &counts, kept), &OPTIONS, |library| {
        let (loaded, note) = library::read(&folder.join(library));
        notes.borrow_mut().extend(note);
        loaded
    });
    let (models, materials) = loaded.map_err(|error| SceneError::Obj {
        path: path.to_owned(),
        line: counts.lines.get(),
        message: error.to_string(),
    })?;
    let mut notes = notes.into_inner();
    match counts.polygons.get() {
        0 => {}
        n => notes.push(format!("{n} polygons of more than four corners cut into fans (right if convex)")),
    }
    let materials = materials.unwrap_or_default().into_iter();
    let materials = materials.map(|material| library::material(material, folder, &mut notes));
    let materials = materials.collect::<Result<Vec<_>, _>>();
    let materials = materials.map_err(|message| SceneError::value(path, message))?;
    check_places(&materials, &counts).map_err(|message| SceneError::value(path, message))?;
    Ok(model_from(models, materials, notes))
}

/// A cut-out without places in its picture would be there or not as the picture's first texel happens to be.
fn check_places(materials: &[Material], counts: &Counts) -> Result<(), String> {
    let bare = counts.bare.borrow();
    let cut = materials.iter().filter(|m| m.mask.as_ref().is_some_and(AlphaMask::varies));
    match cut.filter_map(|m| Some((&m.name, bare.get(&m.name)?))).next() {
        None => Ok(()),
        Some((name, line)) => Err(format!(
            "material '{name}' is cut out by a picture, but the face in line {line} has no texture coordinates (vt): export them, \
             or take map_d out"
        )),
    }
}

/// One more material, grey, stands in wherever the file names none or one that was not found.
fn model_from(models: Vec<tobj::Model>, mut materials: Vec<Material>, mut notes: Vec<String>) -> Model {
    let grey = materials.len();
    let without = models.iter().filter(|model| model.mesh.material_id.is_none()).count();
    if without > 0 {
        notes.push(format!("{without} objects have no known material: grey 0.5"));
        materials.push(Material::grey());
    }
    let object = |model: tobj::Model| Object {
        uvs: uvs(&model.mesh),
        name: model.name,
        positions: model.mesh.positions.chunks_exact(3).map(|p| Vec3::from_slice(p).as_dvec3()).collect(),
        triangles: model.mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        material: model.mesh.material_id.unwrap_or(grey) as u32,
    };
    let objects = models.into_iter().map(object).collect();
    Model { objects, materials, notes, ..Model::default() }
}

/// Per triangle; none for a mesh without. OBJ counts v from the bottom, pictures from the top.
fn uvs(mesh: &tobj::Mesh) -> Vec<[Vec2; 3]> {
    let corner = |&index: &u32| {
        let [u, v] = [0, 1].map(|k| mesh.texcoords.get(2 * index as usize + k).copied().unwrap_or_default());
        Vec2::new(u, 1.0 - v)
    };
    let finite = |uv: Vec2| if uv.is_finite() { uv } else { Vec2::ZERO };
    let triangle = |t: &[u32]| [finite(corner(&t[0])), finite(corner(&t[1])), finite(corner(&t[2]))];
    mesh.texcoord_indices.chunks_exact(3).map(triangle).collect()
}
