//! `cameras.json`.

use super::convention::{Axis, Convention, Handedness, MatrixOrder, Preset, VectorKind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The version of `cameras.json` that this crate reads.
pub(super) const VERSION: u32 = 1;

/// Cameras of another program's frames.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CamerasJson {
    /// 1.
    pub version: u32,
    /// Axes, units and layout.
    pub convention: ConventionJson,
    /// Frames per second; 60 when it is not said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// One entry a frame.
    pub frames: Vec<FrameJson>,
}

/// A preset, a set of axes, or a preset with some of its values replaced.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConventionJson {
    /// An engine; glTF when it is not said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub preset: Option<Preset>,
    /// Must fit the axes: a check on whoever wrote them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub handedness: Option<Handedness>,
    /// The world's axis that becomes the scene file's +x.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub right: Option<Axis>,
    /// The world's axis that becomes the scene file's +y.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub up: Option<Axis>,
    /// The world's axis that becomes the scene file's -z.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub forward: Option<Axis>,
    /// The camera's own axis that points right in its picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera_right: Option<Axis>,
    /// The camera's own axis that points up in its picture.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera_up: Option<Axis>,
    /// The camera's own axis along which it looks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera_forward: Option<Axis>,
    /// Units of the file in a metre.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub units_per_meter: Option<f64>,
    /// How the numbers of a matrix follow each other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub matrix_order: Option<MatrixOrder>,
    /// On which side of a matrix a vector stands.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub vector: Option<VectorKind>,
}

/// A frame's camera.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrameJson {
    /// The number in the frame's file name; its place in the list when it is not said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub index: Option<u32>,
    /// Seconds since the first frame; from `fps` when it is not said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// The frame's file, where its name says no number. For people; the number decides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Camera to world, sixteen numbers.
    pub world_from_camera: [f64; 16],
    /// Vertical field of view in radians.
    pub yfov: f64,
    /// Nearest visible distance, in the file's units; .01 m when it is not said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near: Option<f64>,
    /// Farthest visible distance, in the file's units; 100 km when it is not said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub far: Option<f64>,
    /// Pixels per row, to check the pictures with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<u32>,
    /// Rows, to check the pictures with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<u32>,
    /// How far temporal antialiasing shifts the picture, in pixels; must be 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub jitter: Option<[f64; 2]>,
    /// The picture must be square: a horizontal field of view was given without a size.
    #[serde(skip)]
    pub square: bool,
}

impl ConventionJson {
    pub(super) fn resolve(&self) -> Result<Convention, String> {
        let from = self.preset.unwrap_or(Preset::Gltf).convention();
        let convention = Convention {
            right: self.right.unwrap_or(from.right),
            up: self.up.unwrap_or(from.up),
            forward: self.forward.unwrap_or(from.forward),
            camera_right: self.camera_right.unwrap_or(from.camera_right),
            camera_up: self.camera_up.unwrap_or(from.camera_up),
            camera_forward: self.camera_forward.unwrap_or(from.camera_forward),
            units_per_meter: self.units_per_meter.unwrap_or(from.units_per_meter),
            matrix_order: self.matrix_order.unwrap_or(from.matrix_order),
            vector: self.vector.unwrap_or(from.vector),
        };
        if let Some(problem) = convention.problem() {
            return Err(problem);
        }
        match self.handedness {
            Some(said) if said != convention.handedness() => Err(format!(
                "convention: its axes are {:?}-handed, but handedness says {said:?}",
                convention.handedness()
            )),
            _ => Ok(convention),
        }
    }
}
