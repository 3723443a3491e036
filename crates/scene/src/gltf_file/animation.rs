//! Where a camera of a glTF file is at a time.

use glam::DAffine3;

/// The nodes above a camera, each with its animation.
#[derive(Clone, Debug)]
pub(crate) struct CameraTrack {
    /// The scene file's scale, up axis and translation.
    pub(crate) world_from_file: DAffine3,
}

impl CameraTrack {
    pub(crate) fn duration_secs(&self) -> f64 {
        0.0
    }

    pub(crate) fn pose(&self, _secs: f64) -> DAffine3 {
        self.world_from_file
    }
}
