//! From what the user typed to scenes.

use crate::error::CliError;
use std::path::{Path, PathBuf};
use umbrage_scene::{Scene, SceneFile, builtin_names};

/// As [`find_scene`], under one of the scene's lights, counted from 1. Where there are several, the
/// scene's name says which.
pub(crate) fn find_lit_scene(
    what: &Path,
    light: Option<usize>,
) -> Result<(Scene, Option<SceneFile>), CliError> {
    let (scene, made) = find_scene(what)?;
    let Some(light) = light else { return Ok((scene, made)) };
    if light == 0 || light > scene.lights.len() {
        let count = scene.lights.len();
        return Err(CliError::Usage(format!(
            "{} has no light {light}: its lights are numbered from 1 to {count}",
            scene.name
        )));
    }
    if scene.lights.len() == 1 {
        return Ok((scene, made));
    }
    let (mut file, path) = source_of(&scene.name, what)?;
    file.scored_light = light - 1;
    let name = format!("{}.light-{light}", scene.name);
    Ok((Scene::from_file(&name, &file, &path)?, made))
}

/// The name of a scene, whichever light is scored.
pub(crate) fn family_of(name: &str) -> &str {
    let number = |tail: &str| !tail.is_empty() && tail.bytes().all(|byte| byte.is_ascii_digit());
    name.rsplit_once(".light-").filter(|(_, tail)| number(tail)).map_or(name, |(family, _)| family)
}

/// The light of a command that looks at one.
pub(crate) fn only_light(lights: &[usize]) -> Result<Option<usize>, CliError> {
    match lights {
        [] => Ok(None),
        [light] => Ok(Some(*light)),
        _ => Err(CliError::Usage("--light: one at a time here; `evaluate` takes several".into())),
    }
}

/// The file behind a scene of several lights: no bare model has more than one.
fn source_of(name: &str, what: &Path) -> Result<(SceneFile, PathBuf), CliError> {
    if !what.exists() {
        return Ok((SceneFile::builtin(name)?, what.to_owned()));
    }
    let path = if what.is_dir() { what.join("scene.toml") } else { what.to_owned() };
    Ok((SceneFile::read(&path)?, path))
}

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
