//! Cameras of a glTF file, sampled at the path's frame rate.

use super::{DEFAULT_FRAMES, Pose, Track};
use crate::SceneError;
use crate::model::Model;
use crate::spec::PathSpec;

/// A camera that moves gives as many frames as it lasts, one that stands still the usual number.
pub(super) fn track<'a>(name: &str, spec: &PathSpec, model: &'a Model) -> Result<Track<'a>, SceneError> {
    let names = model.cameras.iter().map(|camera| camera.name.as_str());
    let camera = model.cameras.iter().find(|camera| camera.name == name);
    let camera = camera.ok_or_else(|| SceneError::unknown("camera", name, names))?;
    let fps = spec.frames_per_second;
    let duration_secs = camera.track.duration_secs();
    let title = match duration_secs {
        0.0 => format!("the file's camera '{name}'"),
        secs => format!("the file's camera '{name}', {secs} s of animation"),
    };
    let frames = match duration_secs {
        0.0 => DEFAULT_FRAMES,
        // As u32 saturates: a length beyond all limits is refused by the caller.
        secs => ((secs * fps + 1e-6).floor() as u32).saturating_add(1),
    };
    let pose = Box::new(move |frame: u32| Pose::of(camera.track.pose(f64::from(frame) / fps)));
    Ok(Track { pose, frames, yfov_radians: camera.yfov_radians, title })
}
