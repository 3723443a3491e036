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
    // `scene.toml` alone is named after the folder that it lies in: that folder must be in the path.
    let bare_name = what.exists() && what.parent().is_some_and(|p| p.as_os_str().is_empty());
    let found =
        if bare_name { std::path::absolute(what).map_err(CliError::file(what))? } else { what.to_owned() };
    let (scene, mut file) = Scene::load_with_file(&found)?;
    let bare = what.is_file() && what.extension().is_none_or(|e| e != "toml");
    if bare {
        // The file is kept beside the report: it must find the model from there.
        file.geometry.files = vec![std::path::absolute(what).map_err(CliError::file(what))?];
    }
    Ok((scene, bare.then_some(file)))
}
