//! Views of the standard scenes, made as the program makes them.

use umbrage_frame::View;
use umbrage_scene::{PathFrame, Scene};

/// A scene by name.
pub(crate) fn scene(name: &str) -> Scene {
    Scene::builtin(name).expect("a standard scene")
}

/// A frame of a path.
pub(crate) fn frame_of(scene: &Scene, path: &str, number: usize) -> PathFrame {
    scene.path(path).expect("a standard path").frames[number]
}

/// What a camera sees in a picture of this size.
pub(crate) fn view_of(frame: &PathFrame, (width, height): (u32, u32)) -> View {
    let camera_from_world = frame.camera.camera_from_world();
    let projection = frame.camera.clip_from_camera(width as f32 / height as f32);
    View {
        width,
        height,
        clip_from_world: projection * camera_from_world,
        camera_from_world,
        yfov_radians: frame.camera.yfov_radians,
    }
}
