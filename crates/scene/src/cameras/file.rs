//! `cameras.json`, and NeRF's `transforms.json`.

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
}

/// NeRF's and nerfstudio's format: OpenGL's camera axes, rows, a horizontal field of view.
#[derive(Deserialize, Debug)]
pub(super) struct Transforms {
    camera_angle_x: Option<f64>,
    fl_x: Option<f64>,
    fl_y: Option<f64>,
    cx: Option<f64>,
    cy: Option<f64>,
    w: Option<f64>,
    h: Option<f64>,
    frames: Vec<TransformsFrame>,
}

#[derive(Deserialize, Debug)]
struct TransformsFrame {
    file_path: String,
    transform_matrix: [[f64; 4]; 4],
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

impl Transforms {
    /// The same in `cameras.json`'s terms. The world is Blender's unless told otherwise: that is what these
    /// files are made in.
    pub(super) fn into_cameras(self) -> Result<CamerasJson, String> {
        let aspect = |width: f64, height: f64| if height > 0.0 { width / height } else { 1.0 };
        let centred = |at: Option<f64>, size: Option<f64>| match (at, size) {
            (Some(at), Some(size)) => (at - 0.5 * size).abs() <= 0.5,
            _ => true,
        };
        if !centred(self.cx, self.w) || !centred(self.cy, self.h) {
            return Err("cx and cy are off the centre: lenses that are shifted cannot be scored".into());
        }
        let yfov = match (self.fl_y.or(self.fl_x), self.h, self.camera_angle_x, self.w) {
            (Some(focal), Some(height), ..) => 2.0 * (0.5 * height / focal).atan(),
            (_, Some(height), Some(xfov), Some(width)) => {
                2.0 * ((0.5 * xfov).tan() / aspect(width, height)).atan()
            }
            // A square picture, as NeRF's own have; the pictures' size is checked against it.
            (_, _, Some(xfov), _) => xfov,
            _ => return Err("has neither camera_angle_x nor fl_y with h".into()),
        };
        let whole = |size: Option<f64>| size.map(|s| s as u32);
        let square = self.w.is_none() && self.fl_y.is_none();
        let frame = |(place, frame): (usize, TransformsFrame)| FrameJson {
            index: Some(trailing_number(&frame.file_path).unwrap_or(place as u32)),
            time: None,
            file: Some(frame.file_path),
            world_from_camera: std::array::from_fn(|i| frame.transform_matrix[i / 4][i % 4]),
            yfov,
            near: None,
            far: None,
            width: whole(self.w),
            height: whole(self.h),
            jitter: None,
        };
        let mut frames: Vec<FrameJson> = self.frames.into_iter().enumerate().map(frame).collect();
        if square {
            // Said by a ratio of 1: any size will do that has it.
            frames.iter_mut().for_each(|f| (f.width, f.height) = (Some(0), Some(0)));
        }
        let convention = ConventionJson {
            preset: Some(Preset::Blender),
            matrix_order: Some(MatrixOrder::Row),
            ..ConventionJson::default()
        };
        Ok(CamerasJson { version: VERSION, convention, fps: None, frames })
    }
}

/// "./train/r_12.png" is 12.
fn trailing_number(file: &str) -> Option<u32> {
    let name = file.rsplit(['/', '\\']).next()?;
    let stem =
        name.rsplit_once('.').filter(|(_, end)| end.parse::<u32>().is_err()).map_or(name, |(stem, _)| stem);
    let digits = stem.len() - stem.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    stem[stem.len() - digits..].parse().ok()
}
