//! Arguments of `umbrage reference`.

use super::parse::parse_tolerance;
use super::{TruthArgs, ViewArgs};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct ReferenceArgs {
    /// A scene name, folder or model file.
    pub(crate) scene: PathBuf,
    /// First frame of the path.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) frame: u32,
    /// How many frames; of several, each file's name gets its number.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) frames: u32,
    /// V and the surfaces alone: no irradiance.
    #[arg(long, conflicts_with = "bounces")]
    pub(crate) only_v: bool,
    /// Light samples in each of the two halves.
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(1..=65536))]
    pub(crate) samples: u32,
    /// Standard error of V that is wanted at each pixel, e.g. 0.002: pixels that need it get more
    /// samples; those of E, E0 and R stay. What was reached is said, and written as layer `samples.V`.
    #[arg(long, value_name = "ERROR", value_parser = parse_tolerance)]
    pub(crate) tolerance: Option<f32>,
    /// How the light is sampled, and how samples are looked at.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) method: MethodArg,
    /// Diffuse bounces of the beauty layers R, G, B; without it there is no beauty.
    #[arg(long, value_name = "N")]
    pub(crate) bounces: Option<u32>,
    /// Paths a pixel of the beauty layers.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) beauty_samples: u32,
    /// The EXR file.
    #[arg(long, value_name = "FILE", default_value = "reference.exr")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) truth: TruthArgs,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
}

#[derive(ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum MethodArg {
    /// Jittered scanlines, whole runs of samples at once: the fastest; at most 8192 samples a half.
    #[default]
    Scanlines,
    /// A ray for each sample of the scanlines: their arbiter.
    ScanlineRays,
    /// Sobol points, gathered triangles against each sample.
    Shafts,
    /// A ray for each Sobol point.
    Rays,
}
