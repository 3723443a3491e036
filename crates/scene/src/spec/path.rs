//! `[[path]]`: how the camera, or the light, moves.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A named run of frames as it is written down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathSpec {
    /// Unique in the scene.
    pub name: String,
    /// One line for people; made from the motion when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// How many. When absent: 120, or as many as keyframes or an animation last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<u32>,
    /// Above 0.
    #[serde(default = "sixty")]
    pub frames_per_second: f64,
    /// Vertical field of view, above 0 and below 180. A glTF camera brings its own.
    #[serde(default = "sixty")]
    pub yfov_degrees: f64,
    /// What moves.
    pub motion: Motion,
}

/// What moves along a path. Places are in metres, in the file's coordinates after scale, up axis
/// and translation. Azimuths run from +x (0) towards +z (90).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Motion {
    /// Nothing: a control for what changes without motion.
    Still {
        /// Where the camera is.
        eye: [f64; 3],
        /// What it looks at.
        target: [f64; 3],
    },
    /// Forward, towards the target.
    Dolly {
        /// Where the camera starts.
        eye: [f64; 3],
        /// What it looks at and moves to.
        target: [f64; 3],
        /// Negative moves away.
        metres_per_second: f64,
    },
    /// Round the target on a level circle.
    Orbit {
        /// What it looks at.
        target: [f64; 3],
        /// Distance from the target, above 0.
        radius_world: f64,
        /// Of the view; negative looks down.
        pitch_degrees: f64,
        /// Where on the circle the camera starts, seen from the target.
        azimuth_degrees: f64,
        /// Positive turns from +x towards +z.
        degrees_per_second: f64,
    },
    /// To the right of the view, which does not turn.
    Strafe {
        /// Where the camera starts.
        eye: [f64; 3],
        /// What it looks at in the first frame.
        target: [f64; 3],
        /// Negative moves to the left.
        metres_per_second: f64,
    },
    /// Low over a floor: level heading, sinking eye, changing pitch.
    Oblique {
        /// Where the camera starts.
        eye: [f64; 3],
        /// Where it flies to.
        heading_degrees: f64,
        /// y of the eye in the last frame.
        end_height_world: f64,
        /// In the first frame; negative looks down.
        start_pitch_degrees: f64,
        /// In the last frame.
        end_pitch_degrees: f64,
        /// Level speed.
        metres_per_second: f64,
    },
    /// To the right by a fraction of a pixel per frame, measured at the target's distance.
    Creep {
        /// Where the camera starts.
        eye: [f64; 3],
        /// What it looks at in the first frame.
        target: [f64; 3],
        /// Pixels per frame at the target's distance.
        #[serde(default = "sixteenth")]
        px_per_frame: f64,
        /// Height of the picture in which those pixels are counted.
        #[serde(default = "reference_height")]
        reference_height_px: f64,
    },
    /// The camera stands; the light turns about the vertical axis (a local light: through the
    /// target).
    LightSweep {
        /// Where the camera is.
        eye: [f64; 3],
        /// What it looks at.
        target: [f64; 3],
        /// Positive turns from +x towards +z.
        #[serde(default = "tenth")]
        degrees_per_frame: f64,
    },
    /// Through given poses, inline or from a file; after the last the camera stands.
    Keyframes {
        /// A .json or .toml file with a [`KeyframeList`], relative to the `scene.toml`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        file: Option<PathBuf>,
        /// In order of time; excludes `file`.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        keyframes: Vec<Keyframe>,
        /// Between the poses (with `file`: what the file says).
        #[serde(default)]
        interpolation: Interpolation,
    },
    /// A camera of the glTF file, with its animation if it has one.
    Gltf {
        /// Its name in the file.
        camera: String,
    },
}

/// A file of poses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeyframeList {
    /// In order of time.
    pub keyframes: Vec<Keyframe>,
    /// Between the poses.
    #[serde(default)]
    pub interpolation: Interpolation,
}

/// A pose at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// Since the start; later than the keyframe before.
    pub time_secs: f64,
    /// Where the camera is.
    pub eye: [f64; 3],
    /// What it looks at.
    pub target: [f64; 3],
}

/// How eye and target move from pose to pose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Interpolation {
    /// A smooth curve through all poses: cubic Hermite with Catmull and Rom's tangents, for uneven
    /// times (1974).
    #[default]
    CatmullRom,
    /// Straight.
    Linear,
}

fn sixty() -> f64 {
    60.0
}

fn sixteenth() -> f64 {
    1.0 / 16.0
}

fn tenth() -> f64 {
    0.1
}

fn reference_height() -> f64 {
    720.0
}
