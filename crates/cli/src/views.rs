//! From a scene's cameras to the views that frames are made of.

use crate::error::CliError;
use umbrage_frame::View;
use umbrage_scene::{CameraPath, PathFrame, Scene};

/// The view of a path's frame in a picture of this size.
pub(crate) fn view_of(frame: &PathFrame, (width, height): (u32, u32)) -> View {
    let camera = &frame.camera;
    let camera_from_world = camera.camera_from_world();
    View {
        width,
        height,
        clip_from_world: camera.clip_from_camera(width as f32 / height as f32) * camera_from_world,
        camera_from_world,
        yfov_radians: camera.yfov_radians,
    }
}

/// The path of that name, or the scene's first.
///
/// # Errors
/// A name that the scene does not have, or several.
pub(crate) fn path_of<'a>(scene: &'a Scene, names: &[String]) -> Result<&'a CameraPath, CliError> {
    match names {
        [] => scene.paths.first().ok_or_else(|| CliError::Usage(format!("{} has no path", scene.name))),
        [name] => Ok(scene.path(name)?),
        _ => Err(CliError::Usage("one --path only: this command looks along one".into())),
    }
}

/// A frame of a path.
///
/// # Errors
/// A number beyond its end.
pub(crate) fn frame_of(path: &CameraPath, number: u32) -> Result<&PathFrame, CliError> {
    let message = || format!("{} has {} frames: there is no frame {number}", path.name, path.frames.len());
    path.frames.get(number as usize).ok_or_else(|| CliError::Usage(message()))
}
