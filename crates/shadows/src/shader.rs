//! WGSL fragments and how they become a module: concatenated (module scope has no order), a
//! pass's own file first so that line numbers are its own. A slot is a function of fixed
//! signature that exactly one of several fragments defines.

use std::borrow::Cow;

/// A named piece of WGSL.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Fragment {
    /// File name without its ending.
    pub name: Cow<'static, str>,
    /// The text.
    pub source: Cow<'static, str>,
}

impl Fragment {
    /// A fragment that is part of the program.
    pub const fn new(name: &'static str, source: &'static str) -> Self {
        Self { name: Cow::Borrowed(name), source: Cow::Borrowed(source) }
    }
}

macro_rules! shared {
    ($($constant:ident = $file:literal),* $(,)?) => {
        $(
            #[doc = concat!("`wgsl/", $file, ".wgsl`")]
            pub(crate) const $constant: Fragment =
                Fragment::new($file, include_str!(concat!("wgsl/", $file, ".wgsl")));
        )*
        /// Every shared fragment, for documentation and tests.
        pub fn fragments() -> Vec<Fragment> {
            vec![$($constant),*]
        }
    };
}

shared! {
    GLOBALS = "globals",
    RASTER_CAMERA = "raster_camera",
    RASTER_SHADOW = "raster_shadow",
    RASTER_CAMERA_CUT = "raster_camera_cut",
    RASTER_SHADOW_CUT = "raster_shadow_cut",
    RASTER_CUBE_CUT = "raster_cube_cut",
    RASTER_PEEL_CUT = "raster_peel_cut",
    CUTOUT = "cutout",
    SURFACE = "surface",
    RECEIVER_FRAME = "receiver_frame",
    RECEIVER_ANCHOR = "receiver_anchor",
    ENTRY_SHADE = "entry_shade",
    LIGHT_SUN = "light_sun",
    LIGHT_LOCAL = "light_local",
    BIAS_CONSTANT = "bias_constant",
    BIAS_RECEIVER_PLANE = "bias_receiver_plane",
    TAP = "tap",
    TURN = "turn",
    KERNEL_VOGEL = "kernel_vogel",
    KERNEL_POISSON = "kernel_poisson",
    KERNEL_SPIRAL = "kernel_spiral",
    PATTERN_NONE = "pattern_none",
    PATTERN_IGN = "pattern_ign",
    PATTERN_IGN_TALL = "pattern_ign_tall",
    PATTERN_WHITE = "pattern_white",
    PATTERN_WORLD = "pattern_world",
    CUBE_FACES = "cube_faces",
    RASTER_CUBE = "raster_cube",
    LIGHT_CUBE = "light_cube",
    TAP_CUBE = "tap_cube",
    HASH = "hash",
    SEED_FRESH = "seed_fresh",
    SEED_FROZEN = "seed_frozen",
    SEED_ANIMATED = "seed_animated",
    FILTER_DISC = "filter_disc",
    FILTER_DISC_POINT = "filter_disc_point",
    BLOCKER_SEARCH = "blocker_search",
    LAW_SQUARED = "law_squared",
    LAW_LIGHT = "law_light",
    LAW_CUBE = "law_cube",
    LAW_SCALED = "law_scaled",
    SHAPE_SQUARED = "shape_squared",
    SHAPE_LINEAR = "shape_linear",
    SHAPE_PLANE = "shape_plane",
    SHAPE_DISTANCE = "shape_distance",
    SHAPE_DEPTH01 = "shape_depth01",
    BLUR_TILE = "blur_tile",
    BLUR_DEPTH_AXIS = "blur_depth_axis",
    BLUR_DISTANCE_AXIS = "blur_distance_axis",
    MAX_AXIS = "max_axis",
    MIN_SHRINK = "min_shrink",
    MIN_AXIS = "min_axis",
    FETCH_BILINEAR = "fetch_bilinear",
    PENUMBRA_MASK = "penumbra_mask",
    HARDEN = "harden",
    MIN_MAX_LEVEL = "min_max_level",
    MEAN_LEVEL = "mean_level",
    MAP_BOUNDS = "map_bounds",
    EARLY_BOUNDS = "early_bounds",
    TAP_LEVEL = "tap_level",
    RASTER_PEEL = "raster_peel",
    LIGHT_PATCHES = "light_patches",
    PLANE_SUN = "plane_sun",
    PLANE_LOCAL = "plane_local",
    COLUMN = "column",
    SSSM_SEARCH = "sssm_search",
    SSSM_RADIUS = "sssm_radius",
    SSSM_FILTER = "sssm_filter",
    MOMENT_DEPTH = "moment_depth",
    MOMENTS_BASE = "moments_base",
    MOMENTS_HALVE = "moments_halve",
    MOMENTS_BOX = "moments_box",
    MOMENTS_VARIANCE = "moments_variance",
    MOMENTS_EXPONENTIAL = "moments_exponential",
    MOMENTS_MIPS = "moments_mips",
    MOMENTS_TABLE = "moments_table",
    TABLE_LINE = "table_line",
    SUMMAND_DEPTH = "summand_depth",
    SUMMAND_TABLE = "summand_table",
    CHEBYSHEV = "chebyshev",
    BOUND_REDUCED = "bound_reduced",
    BOUND_LISTING = "bound_listing",
    MOMENTS_SEARCH = "moments_search",
    CAMERA_DEPTH = "camera_depth",
    FRAME_DEPTH = "frame_depth",
    WEIGHT_NONE = "weight_none",
    WEIGHT_DEPTH = "weight_depth",
    WEIGHT_NEAR = "weight_near",
    WEIGHT_PLANE = "weight_plane",
    CHECKERBOARD = "checkerboard",
    WHOLE = "whole",
    TARGET_SCALED = "target_scaled",
    ENTRY_TARGET = "entry_target",
    FILL_CHECKER = "fill_checker",
    SCREEN_PENUMBRA = "screen_penumbra",
    SCREEN_ROWS = "screen_rows",
    HALF_DISC = "half_disc",
}

/// The module's text.
pub(crate) fn concatenate(fragments: &[Fragment]) -> String {
    fragments.iter().map(|f| f.source.as_ref()).collect::<Vec<_>>().join("\n")
}

/// Those of the constants that the module declares: stages share one list, and an override
/// without a value is an error that wgpu reports.
pub(crate) fn declared(source: &str, constants: &[(&'static str, f64)]) -> Vec<(&'static str, f64)> {
    let is_declared = |name: &str| source.contains(&format!("override {name}:"));
    constants.iter().copied().filter(|(name, _)| is_declared(name)).collect()
}
