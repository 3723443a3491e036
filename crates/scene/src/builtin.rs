//! The standard suite, compiled in: it works wherever the program is.

use crate::spec::SceneFile;
use crate::{Scene, SceneError};
use std::path::PathBuf;

/// Name and text of each, in the order in which they are listed.
const BUILTIN: [(&str, &str); 10] = [
    ("edge-ladder", include_str!("../../../scenes/edge-ladder/scene.toml")),
    ("contact", include_str!("../../../scenes/contact/scene.toml")),
    ("thin-poles", include_str!("../../../scenes/thin-poles/scene.toml")),
    ("grating", include_str!("../../../scenes/grating/scene.toml")),
    ("stacked-blockers", include_str!("../../../scenes/stacked-blockers/scene.toml")),
    ("oblique-floor", include_str!("../../../scenes/oblique-floor/scene.toml")),
    ("foliage", include_str!("../../../scenes/foliage/scene.toml")),
    ("colonnade", include_str!("../../../scenes/colonnade/scene.toml")),
    ("curved-receivers", include_str!("../../../scenes/curved-receivers/scene.toml")),
    ("point-light-room", include_str!("../../../scenes/point-light-room/scene.toml")),
];

/// The names of the standard scenes, in the order in which they are listed.
pub fn builtin_names() -> impl ExactSizeIterator<Item = &'static str> {
    BUILTIN.iter().map(|&(name, _)| name)
}

impl Scene {
    /// A standard scene by name.
    ///
    /// # Errors
    /// `UnknownName` with the nearest name when there is none.
    pub fn builtin(name: &str) -> Result<Self, SceneError> {
        let (source, path) = source(name)?;
        Self::from_file(name, &SceneFile::parse(source, &path)?, &path)
    }
}

/// The text of a standard scene, and where it was.
pub(crate) fn source(name: &str) -> Result<(&'static str, PathBuf), SceneError> {
    let found = BUILTIN.iter().find(|(known, _)| *known == name);
    let (_, source) = found.ok_or_else(|| SceneError::unknown("scene", name, builtin_names()))?;
    Ok((source, PathBuf::from(format!("scenes/{name}/scene.toml"))))
}
