//! Wavefront OBJ through tobj, with MTL diffuse colours.
//!
//! tobj parses numbers as f32: a vertex 1 km from the file's origin is exact to .03 mm, one 10 km
//! away to .3 mm; recentring cannot bring back more. Polygons become fans from their first vertex,
//! which is right for convex ones only. An object is a run of faces under one `o` or `g` name and
//! one material. Normals and texture coordinates are left out before tobj sees them.

mod lines;
#[cfg(test)]
mod tests;

use crate::model::{Model, Object};
use crate::{Material, SceneError};
use glam::Vec3;
use lines::{Counts, Lines};
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
    let loaded = tobj::load_obj_buf(&mut Lines::new(bytes, &counts), &OPTIONS, |library| {
        let (loaded, note) = material_library(&folder.join(library));
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
    Ok(model_from(models, materials.unwrap_or_default(), notes))
}

/// One more material, grey, stands in wherever the file names none or one that was not found.
fn model_from(models: Vec<tobj::Model>, materials: Vec<tobj::Material>, mut notes: Vec<String>) -> Model {
    let grey = materials.len();
    let mut materials: Vec<Material> = materials
        .into_iter()
        .map(|m| Material { name: m.name, albedo: m.diffuse.map_or(Vec3::splat(0.5), Vec3::from) })
        .collect();
    let without = models.iter().filter(|model| model.mesh.material_id.is_none()).count();
    if without > 0 {
        notes.push(format!("{without} objects have no known material: grey 0.5"));
        materials.push(Material::grey());
    }
    let object = |model: tobj::Model| Object {
        name: model.name,
        positions: model.mesh.positions.chunks_exact(3).map(|p| Vec3::from_slice(p).as_dvec3()).collect(),
        triangles: model.mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        material: model.mesh.material_id.unwrap_or(grey) as u32,
    };
    let objects = models.into_iter().map(object).collect();
    Model { objects, materials, notes, ..Model::default() }
}

/// The materials of a library; an unreadable one is a note, because shadows need no colours.
fn material_library(path: &Path) -> (tobj::MTLLoadResult, Option<String>) {
    let name = path.display();
    let text = match std::fs::read(path) {
        Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(error) => {
            return (Ok(Default::default()), Some(format!("cannot read {name}: {error}; grey 0.5")));
        }
    };
    let kept: Vec<&str> = text.lines().filter(|line| is_colour(line)).collect();
    match tobj::load_mtl_buf(&mut kept.join("\n").as_bytes()) {
        Ok(loaded) => (Ok(loaded), None),
        Err(error) => (Ok(Default::default()), Some(format!("{name}: {error}; grey 0.5"))),
    }
}

/// The lines of a library that are used here: names and whole diffuse colours (tobj panics at a
/// colour of fewer than three numbers).
fn is_colour(line: &str) -> bool {
    let mut words = line.split_whitespace();
    match words.next() {
        Some("newmtl") => true,
        Some("Kd") => words.by_ref().take(3).filter(|word| word.parse::<f32>().is_ok()).count() == 3,
        _ => false,
    }
}
