//! `[geometry]` and `[shadow_region]`.

use crate::generators::Generator;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Where the surfaces come from: a generator, or model files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GeometrySpec {
    /// A scene made by code; excludes `files`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub generator: Option<Generator>,
    /// OBJ, glTF or GLB files, relative to the folder of the `scene.toml`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<PathBuf>,
    /// Metres per unit of the files (0.01 for centimetres).
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub scale: f64,
    /// Which axis of the files points up.
    #[serde(default, skip_serializing_if = "is_default")]
    pub up: UpAxis,
    /// Added last, in metres.
    #[serde(default, skip_serializing_if = "is_default")]
    pub translate: [f64; 3],
    /// Objects (OBJ groups, glTF nodes) to leave out, by their whole name.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub skip_objects: Vec<String>,
}

/// Which axis points up in a file; the scene's own is y.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum UpAxis {
    /// As in glTF.
    #[default]
    Y,
    /// As in many CAD files: (x, y, z) becomes (x, z, -y).
    Z,
}

/// What an orthographic shadow map covers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShadowRegionSpec {
    /// Centre, in metres.
    pub centre: [f64; 3],
    /// Side of the square map, in metres.
    pub width_world: f64,
    /// Typical distance from blocker to receiver, in metres: sets fixed kernels.
    pub reference_gap_world: f64,
}

impl GeometrySpec {
    /// One model file, in metres, y up.
    pub fn file(path: impl Into<PathBuf>) -> Self {
        Self {
            generator: None,
            files: vec![path.into()],
            scale: 1.0,
            up: UpAxis::Y,
            translate: [0.0; 3],
            skip_objects: Vec::new(),
        }
    }
}

fn one() -> f64 {
    1.0
}

fn is_one(value: &f64) -> bool {
    *value == 1.0
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}
