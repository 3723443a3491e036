//! In which axes, units and layouts an engine writes its cameras.
//!
//! Two bases matter: the world's, as that engine's glTF exporter turns it, and the camera's own. Sources:
//! glTF 2.0 sections 3.4 and 3.10.2; the exporters of each engine (docs/your-engine.md names them).

use glam::{DMat3, DMat4, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A direction along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Axis {
    /// Along x.
    #[serde(rename = "+x")]
    PlusX,
    /// Against x.
    #[serde(rename = "-x")]
    MinusX,
    /// Along y.
    #[serde(rename = "+y")]
    PlusY,
    /// Against y.
    #[serde(rename = "-y")]
    MinusY,
    /// Along z.
    #[serde(rename = "+z")]
    PlusZ,
    /// Against z.
    #[serde(rename = "-z")]
    MinusZ,
}

/// Whether right, up and backward are a right hand's thumb, index and middle finger.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Handedness {
    /// glTF, Blender, Godot, Bevy.
    Right,
    /// Unreal, Unity.
    Left,
}

/// How the sixteen numbers of a matrix follow each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum MatrixOrder {
    /// Column by column, as glTF has them.
    #[default]
    Column,
    /// Row by row.
    Row,
}

/// On which side of a matrix a vector stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum VectorKind {
    /// To its right: the translation is the last column.
    #[default]
    Column,
    /// To its left: the translation is the last row (Unreal).
    Row,
}

/// An engine whose conventions are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Preset {
    /// glTF itself, and three.js.
    Gltf,
    /// Blender: z up; its glTF exporter turns (x, y, z) into (x, z, -y).
    Blender,
    /// Godot 4: as glTF.
    Godot,
    /// Bevy: as glTF.
    Bevy,
    /// Unity: left-handed; its glTF exporters negate x.
    Unity,
    /// Unreal: left-handed, z up, centimetres, row vectors; its glTF exporter turns (x, y, z) into (x, z, y).
    Unreal,
}

/// How cameras are written. What is not given is glTF's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Convention {
    /// The world's axis that becomes the scene file's +x.
    pub right: Axis,
    /// The world's axis that becomes the scene file's +y.
    pub up: Axis,
    /// The world's axis that becomes the scene file's -z.
    pub forward: Axis,
    /// The camera's own axis that points right in its picture.
    pub camera_right: Axis,
    /// The camera's own axis that points up in its picture.
    pub camera_up: Axis,
    /// The camera's own axis along which it looks.
    pub camera_forward: Axis,
    /// Units of the file in a metre: 100 for centimetres.
    pub units_per_meter: f64,
    /// How the numbers of a matrix follow each other.
    pub matrix_order: MatrixOrder,
    /// On which side of a matrix a vector stands.
    pub vector: VectorKind,
}

impl Axis {
    /// The other way along the same axis.
    pub fn flipped(self) -> Self {
        match self {
            Self::PlusX => Self::MinusX,
            Self::MinusX => Self::PlusX,
            Self::PlusY => Self::MinusY,
            Self::MinusY => Self::PlusY,
            Self::PlusZ => Self::MinusZ,
            Self::MinusZ => Self::PlusZ,
        }
    }

    /// As it is written in a file.
    pub fn name(self) -> &'static str {
        match self {
            Self::PlusX => "+x",
            Self::MinusX => "-x",
            Self::PlusY => "+y",
            Self::MinusY => "-y",
            Self::PlusZ => "+z",
            Self::MinusZ => "-z",
        }
    }

    fn vector(self) -> DVec3 {
        match self {
            Self::PlusX => DVec3::X,
            Self::MinusX => DVec3::NEG_X,
            Self::PlusY => DVec3::Y,
            Self::MinusY => DVec3::NEG_Y,
            Self::PlusZ => DVec3::Z,
            Self::MinusZ => DVec3::NEG_Z,
        }
    }
}

impl Preset {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Gltf, Self::Blender, Self::Godot, Self::Bevy, Self::Unity, Self::Unreal];

    /// As it is written in a file and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gltf => "gltf",
            Self::Blender => "blender",
            Self::Godot => "godot",
            Self::Bevy => "bevy",
            Self::Unity => "unity",
            Self::Unreal => "unreal",
        }
    }

    /// The one of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|preset| preset.name() == name)
    }

    /// What it says.
    pub fn convention(self) -> Convention {
        use Axis::{MinusX, MinusY, MinusZ, PlusX, PlusY, PlusZ};
        let gltf = Convention {
            right: PlusX,
            up: PlusY,
            forward: MinusZ,
            camera_right: PlusX,
            camera_up: PlusY,
            camera_forward: MinusZ,
            units_per_meter: 1.0,
            matrix_order: MatrixOrder::Column,
            vector: VectorKind::Column,
        };
        match self {
            Self::Gltf | Self::Godot | Self::Bevy => gltf,
            Self::Blender => Convention { up: PlusZ, forward: PlusY, ..gltf },
            Self::Unity => Convention { right: MinusX, camera_forward: PlusZ, ..gltf },
            Self::Unreal => Convention {
                up: PlusZ,
                forward: MinusY,
                camera_right: PlusY,
                camera_up: PlusZ,
                camera_forward: PlusX,
                units_per_meter: 100.0,
                vector: VectorKind::Row,
                matrix_order: MatrixOrder::Row,
                ..gltf
            },
        }
    }
}

impl Convention {
    /// Of the world.
    pub fn handedness(&self) -> Handedness {
        let basis = basis(self.right, self.up, self.forward);
        if basis.determinant() > 0.0 { Handedness::Right } else { Handedness::Left }
    }

    /// What cannot be: the same axis twice, no unit of length.
    pub(super) fn problem(&self) -> Option<String> {
        let square = |axes: [Axis; 3]| basis(axes[0], axes[1], axes[2]).determinant() != 0.0;
        if !square([self.right, self.up, self.forward]) {
            return Some("convention: right, up and forward must be three different axes".into());
        }
        if !square([self.camera_right, self.camera_up, self.camera_forward]) {
            return Some(
                "convention: camera_right, camera_up and camera_forward must be three different axes".into(),
            );
        }
        (!(self.units_per_meter.is_finite() && self.units_per_meter > 0.0))
            .then(|| format!("convention: units_per_meter must be above 0, is {}", self.units_per_meter))
    }

    /// Camera to world in glTF's axes and metres, from the numbers of a file.
    ///
    /// # Errors
    /// What shows that the numbers follow another convention, in words.
    pub(super) fn world_from_camera(&self, numbers: &[f64; 16]) -> Result<DMat4, String> {
        let mut matrix = DMat4::from_cols_array(numbers);
        if (self.matrix_order == MatrixOrder::Row) != (self.vector == VectorKind::Row) {
            matrix = matrix.transpose();
        }
        let last = matrix.row(3);
        if (last - glam::DVec4::W).length() > 1e-4 {
            let shift = last.truncate().length() > 1e-4 && matrix.w_axis.truncate().length() < 1e-4;
            return Err(match shift {
                true => "its translation stands in the last row: set \"vector\": \"row\", or the other \"matrix_order\"".into(),
                false => format!("the last row of a camera's matrix must be 0 0 0 1, is {last}"),
            });
        }
        let turn = glam::DMat3::from_mat4(matrix);
        let lengths = [turn.x_axis, turn.y_axis, turn.z_axis].map(DVec3::length);
        let straight =
            DMat3::from_cols(turn.x_axis / lengths[0], turn.y_axis / lengths[1], turn.z_axis / lengths[2]);
        let off = (straight.transpose() * straight - DMat3::IDENTITY).to_cols_array();
        if lengths.iter().any(|l| l.is_nan() || *l <= 0.0) || off.iter().any(|v| v.abs() > 1e-3) {
            return Err("its axes are not at right angles: this is no camera-to-world matrix".into());
        }
        let world = basis(self.right, self.up, self.forward).transpose();
        let camera = basis(self.camera_right, self.camera_up, self.camera_forward);
        let turn = world * straight * camera;
        if turn.determinant() < 0.0 {
            return Err("it mirrors the picture: the handedness of the world does not fit that of the camera; check the \
                        convention's axes"
                .into());
        }
        let eye = world * matrix.w_axis.truncate() / self.units_per_meter;
        Ok(DMat4::from_cols(
            turn.x_axis.extend(0.0),
            turn.y_axis.extend(0.0),
            turn.z_axis.extend(0.0),
            eye.extend(1.0),
        ))
    }
}

/// Columns: what becomes +x, +y and +z.
fn basis(right: Axis, up: Axis, forward: Axis) -> DMat3 {
    DMat3::from_cols(right.vector(), up.vector(), -forward.vector())
}
