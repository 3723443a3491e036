//! Wavefront OBJ.

use crate::SceneError;
use crate::model::Model;
use std::path::Path;

pub(crate) fn read(path: &Path) -> Result<Model, SceneError> {
    Err(SceneError::NotAScene { path: path.to_owned() })
}
