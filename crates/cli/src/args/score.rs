//! Arguments of `umbrage score`.

use super::parse::parse_tolerance;
use super::{GateArgs, GpuArgs, ReportKind, TruthArgs};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use umbrage_scene::Preset;

#[derive(Args, Debug)]
pub(crate) struct ScoreArgs {
    /// A scene name, folder or model file: what the frames show.
    #[arg(long, value_name = "SCENE", required_unless_present = "reference_frames")]
    pub(crate) scene: Option<PathBuf>,
    /// A file with the light, as `[[light]]` of a scene file; the scene's first otherwise.
    #[arg(long, value_name = "FILE")]
    pub(crate) light: Option<PathBuf>,
    /// cameras.json, or NeRF's transforms.json.
    #[arg(long, value_name = "FILE", conflicts_with = "path")]
    pub(crate) cameras: Option<PathBuf>,
    /// In place of --cameras: a camera path of the scene, for example a camera that is animated in a glTF file.
    #[arg(long, value_name = "NAME")]
    pub(crate) path: Option<String>,
    /// What the cameras' file is written by, in place of what it says itself: gltf, blender, godot, bevy, unity
    /// or unreal.
    #[arg(long, value_name = "ENGINE", value_parser = parse_preset)]
    pub(crate) convention: Option<Preset>,
    /// Frames, as `shadow.####.exr`, `shadow.%04d.png` or a folder; `NAME=PATTERN` names what is scored.
    /// Several names are variants, several patterns of one name are takes of it with other noise.
    #[arg(long, value_name = "[NAME=]PATTERN", required = true)]
    pub(crate) frames: Vec<String>,
    /// The frames have no randomness: another take would be the same.
    #[arg(long)]
    pub(crate) deterministic: bool,
    /// Channel that holds the shadow; found by its name otherwise.
    #[arg(long, value_name = "NAME")]
    pub(crate) channel: Option<String>,
    /// The same frames without shadows: --frames are then pictures with them, and the shadow is the ratio.
    #[arg(long, value_name = "PATTERN")]
    pub(crate) unshadowed: Option<String>,
    /// The same frames without the light: taken off both before the ratio.
    #[arg(long, value_name = "PATTERN", requires = "unshadowed")]
    pub(crate) ambient: Option<String>,
    /// Linear depth in metres of the same frames, to check the cameras with; a depth channel beside the shadow
    /// is found by itself.
    #[arg(long, value_name = "PATTERN")]
    pub(crate) depth: Option<String>,
    /// How code values of PNGs became light; must be said for them.
    #[arg(long, value_enum)]
    pub(crate) transfer: Option<TransferArg>,
    /// Without cameras: true frames to compare with, frame by frame.
    #[arg(long, value_name = "PATTERN", conflicts_with_all = ["scene", "unshadowed", "ambient", "light", "cameras", "path", "convention", "depth"])]
    pub(crate) reference_frames: Option<String>,
    /// Score even where the cameras seem not to fit the frames.
    #[arg(long)]
    pub(crate) no_projection_check: bool,
    /// Light samples of truth in each of its two halves.
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub(crate) samples: u32,
    /// Standard error of truth that is wanted at each point, e.g. 0.002.
    #[arg(long, value_name = "ERROR", value_parser = parse_tolerance)]
    pub(crate) tolerance: Option<f32>,
    /// Compare with this baseline, and fail on a regression.
    #[arg(long, value_name = "NAME")]
    pub(crate) baseline: Option<String>,
    /// Make this run the baseline of this name; one that exists is replaced.
    #[arg(long, value_name = "NAME")]
    pub(crate) save_baseline: Option<String>,
    #[command(flatten)]
    pub(crate) gate: GateArgs,
    /// Folder of the run.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Folder of cached truth.
    #[arg(long, value_name = "DIR", default_value = "reports/out/cache")]
    pub(crate) cache: PathBuf,
    /// Print the scorecard to standard output, and nothing else there.
    #[arg(long)]
    pub(crate) json: bool,
    /// Where the report's pictures go: `file` (into the page) or `dir` (beside it).
    #[arg(long, value_enum, default_value_t)]
    pub(crate) report: ReportKind,
    #[command(flatten)]
    pub(crate) truth: TruthArgs,
    #[command(flatten)]
    pub(crate) gpu: GpuArgs,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TransferArg {
    /// Code values are in proportion to light.
    Linear,
    /// By sRGB's curve, as screens and screen captures have them.
    Srgb,
}

fn parse_preset(text: &str) -> Result<Preset, String> {
    let names = || Preset::ALL.map(Preset::name).join(", ");
    Preset::named(text).ok_or_else(|| format!("there are {}", names()))
}
