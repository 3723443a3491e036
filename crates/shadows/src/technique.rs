//! What a technique is, and how one is chosen and told what to shade.

use crate::shader::{self, Fragment};
use crate::{Bias, Binding, Globals, Kernels, LightMap, Recording, VARIANTS};
use umbrage_frame::View;
use umbrage_scene::AreaLight;

/// An algorithm at one typed setting. Implemented by the settings of each technique's own file.
pub trait Technique: Sync {
    /// What people and scorecards need to know.
    fn info(&self) -> Info;
    /// Its search and its kernel in a calibration, in words.
    fn kernels(&self, calibration: Calibration) -> Kernels;
    /// Which lights it can do.
    fn lights(&self) -> Lights {
        Lights::All
    }
    /// How it wants the light to see the world.
    fn projection(&self) -> Projection {
        Projection::Single
    }
    /// How many frames before the present one it needs.
    fn history(&self) -> usize {
        0
    }
    /// The user's file that it was read from.
    fn own_file(&self) -> Option<&str> {
        None
    }
    /// Numbers and slots that its user chose, by name, for scorecards.
    fn settings(&self) -> Vec<(String, String)> {
        Vec::new()
    }
    /// Writes the passes of one frame; the last one fills the recording's values.
    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>);
}

/// The lights that a technique can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lights {
    /// Any.
    All,
    /// Suns: its law of the penumbra knows directions only.
    Suns,
    /// Lights that have a place: disks, rectangles, spheres.
    Placed,
}

/// How the light's map is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Projection {
    /// One map: orthographic for a sun, perspective for a light that has a place.
    Single,
    /// The same, wider by the largest penumbra on each side (a guard band).
    Guarded,
    /// Six faces round a light that has a place.
    Cube,
}

/// A technique's description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Info {
    /// One line for people.
    pub title: &'static str,
    /// Seed document and section.
    pub document: &'static str,
    /// What this setting of the technique chooses, in a few words; empty without a choice.
    pub options: String,
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

impl Lights {
    /// Whether a light is one of them.
    pub fn contain(self, light: &AreaLight) -> bool {
        match self {
            Self::All => true,
            Self::Suns => light.centre().is_none(),
            Self::Placed => light.centre().is_some(),
        }
    }

    /// In words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::All => "any light",
            Self::Suns => "suns",
            Self::Placed => "lights that have a place (disk, rect, sphere)",
        }
    }
}

/// The variants of a name: `chss` (both calibrations), `chss/as-printed`, or `all`; empty when
/// unknown.
pub fn select_variants(name: &str) -> Vec<VariantId> {
    let all = VARIANTS.iter().flat_map(|variant| {
        let with = move |calibration| VariantId { variant, calibration };
        Calibration::ALL.map(with)
    });
    all.filter(|id| name == "all" || id.variant.name == name || id.name() == name).collect()
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
    /// Whether any triangle is cut out: raster passes then draw those with a shader of their own.
    pub has_cutouts: bool,
    /// The views of the frames before, newest first; as many as the technique's history.
    pub past: &'a [View],
    /// How many frames ago this is: 0 is the present.
    pub age: usize,
}

impl<'a> Inputs<'a> {
    /// The inputs of so many frames ago. A camera that has no past stood still.
    pub(crate) fn earlier(&self, age: usize) -> Inputs<'a> {
        Inputs { view: self.past.get(age - 1).or(self.past.last()).unwrap_or(self.view), age, ..*self }
    }

    /// The shader of cut-out triangles, where there are any.
    pub(crate) fn cut(&self, own: Fragment, uses: &[Fragment]) -> Vec<Fragment> {
        if !self.has_cutouts {
            return Vec::new();
        }
        [&[own, shader::GLOBALS, shader::CUTOUT], uses].concat()
    }

    /// The globals of the frame that these inputs are about.
    pub(crate) fn own_globals(&self) -> Binding {
        if self.age == 0 { Binding::Globals } else { Binding::EarlierGlobals(self.age) }
    }

    /// A variant's passes with this frame and seed of the pattern.
    pub fn recorded(&self, id: VariantId, pattern: [u32; 2]) -> Recording {
        let technique = id.variant.technique;
        let mut recording = self.recording(pattern, technique.history());
        technique.record(&mut recording, self);
        recording
    }

    /// Globals of this frame and of those before it. A fresh pattern is drawn for every frame of a
    /// history and every frame that looks back at it: estimates over frames then stay independent.
    fn recording(&self, [frame, seed]: [u32; 2], history: usize) -> Recording {
        let mut recording = Recording::new(self.globals(frame, seed));
        for age in 1..=history {
            let ago = frame.wrapping_sub(age as u32);
            let (pattern_frame, pattern_seed) = match self.seeding {
                Seeding::Fresh => (frame, seed ^ (age as u32).wrapping_mul(0x9e37_79b9)),
                Seeding::Frozen | Seeding::Animated => (ago, seed),
            };
            let globals = self.earlier(age).globals(pattern_frame, pattern_seed);
            recording.earlier.push(Globals { frame_index: ago, ..globals });
        }
        recording
    }

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
            frame_index: pattern_frame,
            eye_distance: light.eye_distance,
            far: light.far,
            face_size: light.face_texels(),
        }
    }
}
