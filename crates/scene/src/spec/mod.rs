//! `scene.toml`: what a person writes to describe a scene. Typed, with unknown fields refused;
//! lengths in metres (after `scale`), angles in degrees, and units in every name.
//!
//! Deliberately absent: anything about rendering, and defaults for what is seen. Geometry, lights
//! and paths are always written down.

mod geometry;
mod light;
mod path;
#[cfg(test)]
mod tests;
mod text;

pub use geometry::{GeometrySpec, ShadowRegionSpec, UpAxis};
pub use light::LightSpec;
pub use path::{Interpolation, Keyframe, KeyframeList, Motion, PathSpec};
pub(crate) use text::keyframes_from;

use crate::SceneError;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A `scene.toml`, read but not yet resolved against its model files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// One line for people.
    pub title: String,
    /// Where the surfaces come from.
    pub geometry: GeometrySpec,
    /// What a shadow map must cover; fitted to the model's bounds when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shadow_region: Option<ShadowRegionSpec>,
    /// At least one.
    #[serde(rename = "light")]
    pub lights: Vec<LightSpec>,
    /// Which of them is scored, from 0; chosen by who reads the file, never written in it.
    #[serde(skip)]
    pub scored_light: usize,
    /// At least one; names differ.
    #[serde(rename = "path")]
    pub paths: Vec<PathSpec>,
}

impl SceneFile {
    /// Reads a `scene.toml`.
    ///
    /// # Errors
    /// `Read` when the file is missing, `Syntax` (with line and column) when it does not parse, has
    /// an unknown field, or lacks one.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let source = std::fs::read_to_string(path)
            .map_err(|source| SceneError::Read { path: path.to_owned(), source })?;
        Self::parse(&source, path)
    }

    /// That of a standard scene.
    ///
    /// # Errors
    /// `UnknownName` with the nearest name when there is none.
    pub fn builtin(name: &str) -> Result<Self, SceneError> {
        let (source, path) = crate::builtin::source(name)?;
        Self::parse(source, &path)
    }

    /// Reads the text of a `scene.toml`; `path` is only for messages.
    ///
    /// # Errors
    /// As [`SceneFile::read`].
    pub fn parse(source: &str, path: &Path) -> Result<Self, SceneError> {
        text::from_toml(source, path)
    }

    /// The text of a `scene.toml` that reads back as this, with a few words on how to edit it.
    pub fn to_toml(&self) -> String {
        text::to_toml(self)
    }
}
