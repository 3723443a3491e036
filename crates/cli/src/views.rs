//! From a scene's cameras to the views that frames are made of.

use crate::error::CliError;
use umbrage_frame::View;
use umbrage_scene::{Camera, CameraPath, PathFrame, Scene};
use umbrage_shadows::VARIANTS;

/// The view of a path's frame in a picture of this size.
pub(crate) fn view_of(frame: &PathFrame, size: (u32, u32)) -> View {
    view_from(&frame.camera, size)
}

/// The view of a camera in a picture of this size.
pub(crate) fn view_from(camera: &Camera, (width, height): (u32, u32)) -> View {
    let camera_from_world = camera.camera_from_world();
    View {
        width,
        height,
        clip_from_world: camera.clip_from_camera(width as f32 / height as f32) * camera_from_world,
        camera_from_world,
        yfov_radians: camera.yfov_radians,
    }
}

/// The views of the frames before one of a path, newest first: as many as any technique looks back,
/// fewer at the start of the path, before which the camera stood still.
pub(crate) fn past_of(path: &CameraPath, number: u32, size: (u32, u32)) -> Vec<View> {
    let most = VARIANTS.iter().map(|v| v.technique.history() as u32).max().unwrap_or(0);
    let numbers = (1..=most).map_while(|age| number.checked_sub(age));
    numbers.filter_map(|n| Some(view_of(path.frames.get(n as usize)?, size))).collect()
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
