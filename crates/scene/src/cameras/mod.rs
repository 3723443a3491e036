//! Cameras of frames that another program rendered: `cameras.json` (schema shipped beside this crate) and
//! NeRF's `transforms.json`. Cameras of a glTF file are paths of its scene.
//!
//! Nothing here looks at pictures: whether the cameras fit them is asked where frames are scored.

mod convention;
mod file;
#[cfg(test)]
mod tests;
mod transforms;

pub use convention::{Axis, Convention, Handedness, MatrixOrder, Preset, VectorKind};
pub use file::{CamerasJson, ConventionJson, FrameJson};

use crate::{Camera, SceneError};
use glam::DVec3;
use std::path::{Path, PathBuf};

/// Largest number of a place, in the file's units.
const FARTHEST: f64 = 1e15;
/// Frames per second where a file does not say.
const USUAL_FPS: f64 = 60.0;

/// Cameras as they were read, so that they can be read again in another convention.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraFile {
    /// Where they were read.
    pub path: PathBuf,
    /// Frames per second.
    pub frames_per_second: f64,
    /// How they are written.
    pub convention: Convention,
    frames: Vec<FrameJson>,
}

/// A camera and which frame it belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameCamera {
    /// The number in the frame's file name.
    pub index: u32,
    /// Seconds since the first frame.
    pub time_secs: f32,
    /// In the scene's space.
    pub camera: Camera,
    /// Width and height of the picture, where the file says.
    pub size: Option<(u32, u32)>,
    /// The picture must be square: a horizontal field of view without a size.
    pub square: bool,
}

impl CameraFile {
    /// Reads `cameras.json` or `transforms.json`; a preset replaces the file's own convention.
    ///
    /// # Errors
    /// A file that cannot be read, does not parse (with its line), or says what cannot be (with its frame).
    pub fn read(path: &Path, preset: Option<Preset>) -> Result<Self, SceneError> {
        let read = |source| SceneError::Read { path: path.to_owned(), source };
        Self::parse(&std::fs::read_to_string(path).map_err(read)?, path, preset)
    }

    /// Reads a text; `path` is for messages.
    ///
    /// # Errors
    /// As [`CameraFile::read`].
    pub fn parse(text: &str, path: &Path, preset: Option<Preset>) -> Result<Self, SceneError> {
        let syntax = |e: serde_json::Error| SceneError::Syntax {
            path: path.to_owned(),
            line: e.line(),
            column: e.column(),
            message: e.to_string(),
        };
        let refuse = |message: String| SceneError::value(path, message);
        let any: serde_json::Value = serde_json::from_str(text).map_err(syntax)?;
        let mut cameras: CamerasJson = if any.get("frames").is_some_and(has_transforms) {
            serde_json::from_str::<transforms::Transforms>(text)
                .map_err(syntax)?
                .into_cameras()
                .map_err(refuse)?
        } else {
            serde_json::from_str(text).map_err(syntax)?
        };
        if cameras.version != file::VERSION {
            return Err(refuse(format!(
                "version {} is not known: this program reads version {}",
                cameras.version,
                file::VERSION
            )));
        }
        if let Some(preset) = preset {
            // Numbers follow each other as the file says unless the preset is all there is to know.
            let matrix_order = cameras.convention.matrix_order;
            cameras.convention =
                ConventionJson { preset: Some(preset), matrix_order, ..ConventionJson::default() };
        }
        let convention = cameras.convention.resolve().map_err(refuse)?;
        let frames_per_second = cameras.fps.unwrap_or(USUAL_FPS);
        if !(frames_per_second.is_finite() && frames_per_second > 0.0) {
            return Err(refuse(format!("fps must be above 0, is {frames_per_second}")));
        }
        let file = Self { path: path.to_owned(), frames_per_second, convention, frames: cameras.frames };
        file.check()?;
        Ok(file)
    }

    /// Every camera in order of its frame's number, in a scene whose coordinates are those of its file less
    /// `origin`, if the cameras are written as `convention` says.
    ///
    /// # Errors
    /// A matrix that is no camera's in that convention.
    pub fn cameras(&self, convention: &Convention, origin: DVec3) -> Result<Vec<FrameCamera>, SceneError> {
        let mut all: Vec<FrameCamera> = Vec::new();
        for (place, frame) in self.frames.iter().enumerate() {
            let index = frame.index.unwrap_or(place as u32);
            let refuse = |message: String| self.refuse(place, message);
            let pose = convention.world_from_camera(&frame.world_from_camera).map_err(refuse)?;
            let mut world_from_camera = pose;
            world_from_camera.w_axis -= origin.extend(0.0);
            let metres = |units: Option<f64>, usual: f64| {
                units.map_or(usual, |u| u / convention.units_per_meter) as f32
            };
            let camera = Camera {
                world_from_camera: world_from_camera.as_mat4(),
                yfov_radians: frame.yfov as f32,
                near_world: metres(frame.near, 0.01),
                far_world: metres(frame.far, 1e5),
            };
            let time_secs = frame.time.unwrap_or(place as f64 / self.frames_per_second) as f32;
            let (size, square) = (frame.width.zip(frame.height), frame.square);
            all.push(FrameCamera { index, time_secs, camera, size, square });
        }
        all.sort_by_key(|frame| frame.index);
        Ok(all)
    }

    fn refuse(&self, place: usize, message: String) -> SceneError {
        let index = self.frames[place].index.unwrap_or(place as u32);
        SceneError::value(&self.path, format!("frame {index}: {message}"))
    }

    /// What makes no sense in any convention.
    fn check(&self) -> Result<(), SceneError> {
        if self.frames.is_empty() {
            return Err(SceneError::value(&self.path, "has no frames"));
        }
        let mut seen = std::collections::BTreeSet::new();
        for (place, frame) in self.frames.iter().enumerate() {
            let refuse = |message: String| Err(self.refuse(place, message));
            if !seen.insert(frame.index.unwrap_or(place as u32)) {
                return refuse("is there twice".into());
            }
            match (frame.width, frame.height) {
                (Some(1..), Some(1..)) | (None, None) => {}
                (Some(_), Some(_)) => return refuse("width and height must be above 0".into()),
                (Some(_), None) => {
                    return refuse("has a width without a height: give both, or neither".into());
                }
                (None, Some(_)) => {
                    return refuse("has a height without a width: give both, or neither".into());
                }
            }
            if frame.world_from_camera.iter().any(|v| !v.is_finite()) {
                return refuse("world_from_camera is not finite".into());
            }
            if !(frame.yfov > 0.0 && frame.yfov < std::f64::consts::PI) {
                let degrees = if frame.yfov >= std::f64::consts::PI { "; degrees, perhaps?" } else { "" };
                return refuse(format!("yfov must be in radians, 0 to 3.14, is {}{degrees}", frame.yfov));
            }
            if frame.world_from_camera.iter().chain(&frame.near).chain(&frame.far).any(|v| v.abs() > FARTHEST)
            {
                return refuse(format!(
                    "a place or a distance is above {FARTHEST:e}: no f32 holds a scene of that size"
                ));
            }
            let (near, far) = (frame.near.unwrap_or(1e-6), frame.far.unwrap_or(f64::MAX));
            if !(near > 0.0 && near < far) {
                return refuse(format!("near must be above 0 and below far, is {near} (far {far})"));
            }
            if let Some([x, y]) = frame.jitter.filter(|j| *j != [0.0; 2]) {
                return refuse(format!(
                    "its picture is shifted by ({x}, {y}) px: render without the jitter of temporal antialiasing, which \
                     would count as swimming"
                ));
            }
        }
        let convention = self.convention;
        self.cameras(&convention, DVec3::ZERO).map(|_| ())
    }
}

fn has_transforms(frames: &serde_json::Value) -> bool {
    frames.as_array().is_some_and(|all| all.iter().any(|f| f.get("transform_matrix").is_some()))
}

/// The JSON schema of `cameras.json`.
pub fn cameras_schema() -> String {
    let schema = schemars::schema_for!(CamerasJson);
    // A schema is a map of strings: it always has a text.
    serde_json::to_string_pretty(&schema).unwrap_or_default() + "\n"
}
