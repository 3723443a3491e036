//! From what the user typed to scenes.

use crate::error::CliError;
use std::path::Path;
use umbrage_scene::{Scene, SceneFile, builtin_names};

/// A standard scene by name, otherwise a folder or file; with the scene file that was made for a
/// bare model.
pub(crate) fn find_scene(what: &Path) -> Result<(Scene, Option<SceneFile>), CliError> {
    let name = what.to_string_lossy();
    if builtin_names().any(|known| known == name) {
        return Ok((Scene::builtin(&name)?, None));
    }
    if !what.exists() && what.extension().is_none() && what.components().count() == 1 {
        // A plain word: the error names the nearest standard scene.
        return Ok((Scene::builtin(&name)?, None));
    }
    let (scene, file) = Scene::load_with_file(what)?;
    let bare = what.is_file() && what.extension().is_none_or(|e| e != "toml");
    Ok((scene, bare.then_some(file)))
}
