//! From a path on disk to a [`Scene`].

use crate::assemble::assemble;
use crate::fitted;
use crate::model::Model;
use crate::spec::{GeometrySpec, SceneFile, UpAxis};
use crate::{Scene, SceneError, gltf_file, obj};
use glam::{DAffine3, DMat3, DVec3};
use std::path::Path;

impl Scene {
    /// Reads a scene: a folder with a `scene.toml`, a `.toml` file, or a bare model (`.obj`,
    /// `.gltf`, `.glb`), which gets the light and the paths of [`SceneFile::for_model`].
    ///
    /// # Errors
    /// Any [`SceneError`]; nothing is half loaded.
    pub fn load(path: &Path) -> Result<Self, SceneError> {
        Self::load_with_file(path).map(|(scene, _)| scene)
    }

    /// Like [`Scene::load`], and gives the scene file that was used: read, or made for a bare
    /// model.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn load_with_file(path: &Path) -> Result<(Self, SceneFile), SceneError> {
        if path.is_dir() {
            let file = path.join("scene.toml");
            return from_toml(&file, &name_of(path));
        }
        match extension(path).as_deref() {
            Some("toml") => {
                let folder = path.parent().filter(|_| path.file_stem().is_some_and(|stem| stem == "scene"));
                from_toml(path, &name_of(folder.filter(|f| f.file_name().is_some()).unwrap_or(path)))
            }
            Some("obj" | "gltf" | "glb") => {
                let model = read_model(path)?;
                let file = fitted::file_for(&model, path)?;
                let scene = assemble(&name_of(path), &file, model, path)?;
                Ok((scene, file))
            }
            _ => Err(SceneError::NotAScene { path: path.to_owned() }),
        }
    }

    /// Builds the scene that a scene file describes. `path` is the file that it was, or might have
    /// been, read from: model files are looked for beside it.
    ///
    /// # Errors
    /// As [`Scene::load`].
    pub fn from_file(name: &str, file: &SceneFile, path: &Path) -> Result<Self, SceneError> {
        assemble(name, file, model_of(&file.geometry, path)?, path)
    }
}

impl SceneFile {
    /// A scene file for a bare model: a sun of 2 degrees at elevation 50 and azimuth 30, a shadow
    /// region and floor-level paths fitted to the bounds, and a path for each camera of the model.
    /// It names the model as `path` does: make it absolute if the text is to be kept elsewhere.
    ///
    /// # Errors
    /// Those of reading the model.
    pub fn for_model(path: &Path) -> Result<Self, SceneError> {
        fitted::file_for(&read_model(path)?, path)
    }
}

fn from_toml(path: &Path, name: &str) -> Result<(Scene, SceneFile), SceneError> {
    let file = SceneFile::read(path)?;
    Ok((Scene::from_file(name, &file, path)?, file))
}

/// The last part of a path without its extension.
fn name_of(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_string_lossy().to_lowercase())
}

fn model_of(spec: &GeometrySpec, path: &Path) -> Result<Model, SceneError> {
    let mut model = match (spec.generator, spec.files.is_empty()) {
        (Some(generator), true) => generator.model(),
        (None, false) => read_models(spec, path)?,
        _ => return Err(SceneError::value(path, "geometry needs either a generator or files")),
    };
    skip_objects(&mut model, &spec.skip_objects)?;
    model.transform(world_from_file(spec, path)?);
    Ok(model)
}

fn read_models(spec: &GeometrySpec, path: &Path) -> Result<Model, SceneError> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut model = Model::default();
    for file in &spec.files {
        model.append(read_model(&folder.join(file))?);
    }
    Ok(model)
}

fn read_model(path: &Path) -> Result<Model, SceneError> {
    let model = match extension(path).as_deref() {
        Some("obj") => obj::read(path)?,
        Some("gltf" | "glb") => gltf_file::read(path)?,
        _ => return Err(SceneError::NotAScene { path: path.to_owned() }),
    };
    model.check(path)?;
    Ok(model)
}

/// A name that nothing has is a mistake: the object would stay, unseen by the author.
fn skip_objects(model: &mut Model, names: &[String]) -> Result<(), SceneError> {
    for name in names {
        let before = model.objects.len();
        let existing: Vec<String> = model.objects.iter().map(|object| object.name.clone()).collect();
        model.objects.retain(|object| object.name != *name);
        if model.objects.len() == before {
            return Err(SceneError::unknown("object", name, existing.iter().map(String::as_str)));
        }
        model.notes.push(format!("object '{name}' left out, as asked"));
    }
    Ok(())
}

fn world_from_file(spec: &GeometrySpec, path: &Path) -> Result<DAffine3, SceneError> {
    if !(spec.scale.is_finite() && spec.scale > 0.0) {
        return Err(SceneError::value(path, format!("scale must be above 0, is {}", spec.scale)));
    }
    let translate = DVec3::from(spec.translate);
    if !translate.is_finite() {
        return Err(SceneError::value(path, "translate must be finite"));
    }
    let turn = match spec.up {
        UpAxis::Y => DMat3::IDENTITY,
        UpAxis::Z => DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y),
    };
    Ok(DAffine3::from_mat3_translation(turn * spec.scale, translate))
}
