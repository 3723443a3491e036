//! glTF 2.0 through the gltf crate: meshes under their nodes' transforms, base colours, cut-outs
//! (`MASK`), perspective cameras and their animation.
//!
//! Deliberately absent: skins, morph targets, translucency, the file's own lights (they have no size).
//! What is left out and would be missed is said in a note.

mod accessor;
mod animation;
mod instances;
mod materials;
mod mesh;
mod nodes;
#[cfg(test)]
mod tests;

pub(crate) use animation::CameraTrack;

use crate::SceneError;
use crate::model::Model;
use accessor::Buffers;
use gltf::json::Root;
use gltf::json::validation::Checked;
use gltf::material::AlphaMode;
use gltf::mesh::Semantic;
use gltf::{Document, Gltf};
use materials::Materials;
use std::path::Path;

pub(crate) fn read(path: &Path) -> Result<Model, SceneError> {
    let bytes = std::fs::read(path).map_err(|source| SceneError::Read { path: path.to_owned(), source })?;
    parse(&bytes, path)
}

/// `path` is for messages, and its folder for buffers.
pub(crate) fn parse(bytes: &[u8], path: &Path) -> Result<Model, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    model_from(bytes, folder).map_err(|message| SceneError::Gltf { path: path.to_owned(), message })
}

fn model_from(bytes: &[u8], folder: &Path) -> Result<Model, String> {
    check_header(bytes)?;
    let Gltf { document, blob } =
        Gltf::from_slice_without_validation(bytes).map_err(|error| error.to_string())?;
    let mut root = document.into_json();
    check_references(&root)?;
    // The gltf crate has its own, shorter list of those that it knows.
    root.extensions_required.clear();
    let document = Document::from_json(root).map_err(|error| error.to_string())?;
    let buffers = Buffers::read(&document, blob, folder)?;
    let mut materials = Materials::read(&document, &buffers, folder)?;
    let mut notes = notes(&document);
    notes.append(&mut materials.notes);
    let mut model = Model { materials: std::mem::take(&mut materials.all), notes, ..Model::default() };
    let nodes = nodes::placed(&document)?;
    for (at, placed) in nodes.iter().enumerate() {
        mesh::add(&mut model, placed, (&document, &buffers), &materials.layouts)?;
        nodes::add_camera(&mut model, &nodes, at, (&document, &buffers))?;
    }
    Ok(model)
}

/// The gltf crate subtracts the header's size from a length that it has not checked.
fn check_header(bytes: &[u8]) -> Result<(), String> {
    let length = bytes.get(8..12).and_then(|b| b.try_into().ok()).map_or(0, u32::from_le_bytes);
    if bytes.starts_with(b"glTF") && length < 12 {
        return Err("the binary header is truncated or damaged".to_owned());
    }
    Ok(())
}

/// References that the gltf crate's validation follows (a mesh's attributes) or forgets (what an
/// animation moves) without a check of its own.
fn check_references(root: &Root) -> Result<(), String> {
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let mut accessors = primitives.flat_map(|primitive| primitive.attributes.values());
    if let Some(missing) = accessors.find(|index| index.value() >= root.accessors.len()) {
        return Err(format!("a mesh uses accessor {missing}, which does not exist"));
    }
    if let Some(unknown) = root.extensions_required.iter().find(|name| !is_known(name)) {
        return Err(format!(
            "it needs the extension {unknown}, which is not read: export it without (in Blender: without compression)"
        ));
    }
    for (i, animation) in root.animations.iter().enumerate() {
        for channel in &animation.channels {
            let known = channel.target.node.value() < root.nodes.len();
            if !known || matches!(channel.target.path, Checked::Invalid) {
                return Err(format!("animation {i} moves a node or property that does not exist"));
            }
        }
    }
    Ok(())
}

/// Extensions that are read, or that change no shape.
fn is_known(extension: &str) -> bool {
    let read = ["KHR_texture_transform", "EXT_mesh_gpu_instancing", "KHR_lights_punctual"];
    read.contains(&extension) || extension.starts_with("KHR_materials_")
}

fn notes(document: &Document) -> Vec<String> {
    let translucent = document.materials().filter(|m| m.alpha_mode() == AlphaMode::Blend).count();
    let moved = document.nodes().filter(|n| n.skin().is_some() || n.weights().is_some()).count();
    let lights = document.nodes().filter(|n| n.light().is_some()).count();
    let coloured = document.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
    let cut_by_vertex = coloured.filter(|primitive| {
        primitive.material().alpha_mode() == AlphaMode::Mask && primitive.get(&Semantic::Colors(0)).is_some()
    });
    let all = [
        (translucent, "materials are translucent (BLEND) in the file, opaque here"),
        (cut_by_vertex.count(), "cut-out parts have vertex colours, whose alpha is not read"),
        (lights, "lights of the file have no size and are left out: [[light]] in scene.toml gives one"),
        (moved, "nodes have a skin or morph targets and stand as they were modelled"),
    ];
    all.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")).collect()
}
