//! What a technique is, and how one is chosen and told what to shade.

use crate::{Bias, Globals, Kernels, LightMap, Recording, VARIANTS};
use umbrage_frame::View;

/// An algorithm at one typed setting. Implemented by the settings of each technique's own file.
pub trait Technique: Sync {
    /// What people and scorecards need to know.
    fn info(&self) -> Info;
    /// Its search and its kernel in a calibration, in words.
    fn kernels(&self, calibration: Calibration) -> Kernels;
    /// Writes the passes of one frame; the last one fills the recording's values.
    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>);
}

/// A technique's description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Info {
    /// One line for people.
    pub title: &'static str,
    /// Seed document and section.
    pub document: &'static str,
    /// Shadow-map taps of the last pass and of searches: "32 search + 16 x 4".
    pub taps: String,
    /// Whether its pattern changes from pixel to pixel: then several seeds are needed.
    pub stochastic: bool,
}

/// Whether kernels are those of the document or those of the true light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Calibration {
    /// Kernel radii derived from the light, receiver-plane bias.
    LightMatched,
    /// Constants of the seed document.
    AsPrinted,
}

impl Calibration {
    /// Both, in display order.
    pub const ALL: [Self; 2] = [Self::LightMatched, Self::AsPrinted];

    /// As in names and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::LightMatched => "light-matched",
            Self::AsPrinted => "as-printed",
        }
    }
}

/// A technique at a named setting.
pub struct Variant {
    /// Unique, lower case: `chss-mask`.
    pub name: &'static str,
    /// The algorithm with its settings.
    pub technique: &'static dyn Technique,
}

/// A variant in one calibration: what is scored.
#[derive(Clone, Copy)]
pub struct VariantId {
    /// Which.
    pub variant: &'static Variant,
    /// With which kernels.
    pub calibration: Calibration,
}

impl VariantId {
    /// `chss-mask/light-matched`.
    pub fn name(&self) -> String {
        format!("{}/{}", self.variant.name, self.calibration.name())
    }
}

/// The variants of a name: `chss` (both calibrations) or `chss/as-printed`; empty when unknown.
pub fn select_variants(name: &str) -> Vec<VariantId> {
    let all = VARIANTS.iter().flat_map(|variant| {
        let with = move |calibration| VariantId { variant, calibration };
        Calibration::ALL.map(with)
    });
    all.filter(|id| id.variant.name == name || id.name() == name).collect()
}

/// What the last pass shades.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Receivers {
    /// The pixels of the frame (pictures, costs).
    Frame,
    /// Anchors set beforehand (scores).
    Anchors {
        /// How many.
        count: u32,
    },
}

/// How a stochastic pattern varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seeding {
    /// An offset of its own for each frame, seed and block of 16x16 (scores).
    Fresh,
    /// The same in each frame, as many games ship it.
    Frozen,
    /// Moving along from frame to frame, for temporal filters.
    Animated,
}

/// What a technique may use.
#[derive(Clone, Copy)]
pub struct Inputs<'a> {
    /// From where.
    pub view: &'a View,
    /// How the light sees the world.
    pub light: &'a LightMap,
    /// Which kernels.
    pub calibration: Calibration,
    /// What keeps surfaces from shadowing themselves.
    pub bias: Bias,
    /// What is shaded.
    pub receivers: Receivers,
    /// How patterns vary.
    pub seeding: Seeding,
    /// Hash of the geometry, for maps that are kept.
    pub geometry_key: u64,
}

impl Inputs<'_> {
    /// The uniform block for one frame and seed of the pattern.
    pub fn globals(&self, pattern_frame: u32, pattern_seed: u32) -> Globals {
        let (view, light) = (self.view, self.light);
        let tan = (0.5 * view.yfov_radians).tan();
        Globals {
            world_from_camera: view.camera_from_world.inverse().to_cols_array_2d(),
            clip_from_world: view.clip_from_world.to_cols_array_2d(),
            light_from_world: light.light_from_world.to_cols_array_2d(),
            light_clip_from_world: light.clip_from_world.to_cols_array_2d(),
            frame_size: [view.width, view.height],
            receivers: match self.receivers {
                Receivers::Frame => view.width * view.height,
                Receivers::Anchors { count } => count,
            },
            map_size: light.texels,
            half_extent: [tan * view.width as f32 / view.height as f32, tan],
            map_scale: light.scale,
            light_size: light.light_size,
            nearest_blocker: light.nearest_blocker,
            reference_gap: light.reference_gap,
            pattern_frame,
            pattern_seed,
        }
    }
}
