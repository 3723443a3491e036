//! What was scored, and where: variants and windows.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// T frames of a path through a scene, scored together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WindowCard {
    /// Name of the scene.
    pub scene: String,
    /// Name of the camera path.
    pub path: String,
    /// Index on the path of the window's first frame.
    pub first_frame: u32,
    /// Frames in the window, T.
    pub frames: u32,
    /// Numbers from a frame to the next: above 1 where another program's frames skip some.
    #[serde(default = "crate::card::one", skip_serializing_if = "crate::card::is_one")]
    pub step: u32,
    /// What moves, and how fast: "camera, 2.00 m/s forward".
    pub speed: String,
    /// Anchors that were scored.
    pub anchors: u64,
    /// Penumbra tiles.
    pub tiles: u64,
    /// Of the anchors that face the light, the share that was scored, 0 to 1.
    pub coverage: f64,
    /// Of the pixels of the middle frame, the share that was scored, 0 to 1. Below `coverage`: sky
    /// and what faces away from the light are pixels too. 0 in a file older than this field.
    #[serde(default)]
    pub picture: f64,
    /// Of the anchors inside the picture, over all frames, the share where truth and raster saw
    /// different surfaces, 0 to 1.
    pub disagreement: f64,
    /// Of the anchors inside the picture, over all frames, the share hidden behind something else
    /// as the camera moves, 0 to 1: parallax, not disagreement. 0 in a file older than this field.
    #[serde(default)]
    pub occluded: f64,
    /// Truth's own mean squared error (visibility squared), from its two halves.
    pub reference_noise: f64,
    /// Seconds that truth took; none when it came from the cache.
    pub truth_secs: Option<f64>,
    /// Anything else that a reader should know.
    pub notes: Vec<String>,
}

/// Where a variant's constants come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Calibration {
    /// The constants of the document that describes it.
    AsPrinted,
    /// Kernel sizes derived from the light of the scene.
    LightMatched,
    /// Another program's frames: its constants are its own.
    Elsewhere,
}

impl Calibration {
    /// As in `scorecard.json` and in the program's arguments.
    pub fn id(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::LightMatched => "light-matched",
            Self::Elsewhere => "elsewhere",
        }
    }

    /// As printed on pages.
    pub fn label(self) -> &'static str {
        match self {
            Self::AsPrinted => "as printed",
            Self::LightMatched => "light-matched",
            Self::Elsewhere => "from elsewhere",
        }
    }
}

/// A technique at one setting.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct VariantCard {
    /// Its name: `chss-mask`. Both calibrations of a name share a colour.
    pub name: String,
    /// The technique that it is a setting of.
    pub technique: String,
    /// Where its constants come from.
    pub calibration: Calibration,
    /// Taps a pixel: "16", "32 + 16".
    pub taps: String,
    /// Full-screen passes a frame.
    pub passes: u32,
    /// Its settings in words: part of the score.
    pub settings: SettingsCard,
    /// The document that describes it.
    pub source: String,
    /// One plain sentence: what it does.
    pub sentence: String,
}

/// Settings that are part of a score, each in words with its unit.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct SettingsCard {
    /// Constant depth bias.
    pub bias_constant: String,
    /// Normal-offset bias.
    pub bias_normal_offset: String,
    /// Receiver-plane bias.
    pub bias_receiver_plane: String,
    /// Radius of the blocker search.
    pub search_radius: String,
    /// Largest filter kernel.
    pub kernel_cap: String,
    /// What the radius of the sample set means.
    pub radius_convention: String,
    /// What a tap outside the shadow map returns.
    pub outside_the_map: String,
    /// Further settings, by name.
    #[serde(default)]
    pub more: BTreeMap<String, String>,
}
