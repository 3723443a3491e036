//! The command line.

mod figure;
mod gate;
mod parse;
mod reference;
mod score;
mod technique;

use clap::{Args, Parser, Subcommand, ValueEnum};
pub(crate) use figure::FigureArgs;
pub(crate) use gate::{AcceptArgs, CompareArgs, FailOn, GateArgs, Plant};
pub(crate) use parse::check_size;
use parse::{parse_bias, parse_light, parse_size, parse_tolerance};
pub(crate) use reference::{MethodArg, ReferenceArgs};
pub(crate) use score::{ScoreArgs, TransferArg};
use std::path::PathBuf;
pub(crate) use technique::TechniqueArgs;
use umbrage_shadows::Bias;

/// Scores real-time soft shadows against path-traced truth: error, banding, noise and swimming.
#[derive(Parser, Debug)]
#[command(name = "umbrage", version, after_help = EXIT_CODES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 pass (warnings allowed), 1 regression or a threshold failed, 2 usage, \
3 not comparable (or nothing that truth and raster both see), 4 input, file or GPU failure, 5 no baseline, 130 interrupted.";

#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Render truth and variants, score them, write the report: the main job.
    Evaluate(EvaluateArgs),
    /// Frames of another engine against truth for the same cameras.
    Score(Box<ScoreArgs>),
    /// The gate: a stored run against a baseline.
    Compare(CompareArgs),
    /// Makes a stored run the baseline.
    Accept(AcceptArgs),
    /// What the seed documents say, measured: a verdict on every claim.
    Claims(ClaimsArgs),
    /// Ground truth of one frame to EXR.
    Reference(ReferenceArgs),
    /// One variant to EXR.
    Render(RenderArgs),
    /// Pages from a stored run.
    Report(ReportArgs),
    /// Crops, plots, tables and animations for a paper, from a stored run.
    ///
    /// Writes crops.png with insets (their values in crop-N.exr), plots as SVG and PDF, scores.tex and scores.csv, the
    /// path as APNG and, where ffmpeg is on the PATH, as MP4, and captions.txt, which says what is where.
    Figure(FigureArgs),
    /// What there is.
    List(ListArgs),
}

/// Flags of everything that looks at a scene.
#[derive(Args, Debug, Clone)]
pub(crate) struct ViewArgs {
    /// Picture size.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Camera path (several by repeating); all of the suite's otherwise.
    #[arg(long = "path", value_name = "NAME")]
    pub(crate) paths: Vec<String>,
    /// Light by its number in the scene, from 1 (several by repeating, scored one at a time); the first
    /// otherwise.
    #[arg(long = "light", value_name = "N", value_parser = parse_light)]
    pub(crate) lights: Vec<usize>,
    /// Side of the shadow map in texels.
    #[arg(long, value_name = "TEXELS", default_value_t = 2048)]
    pub(crate) map: u32,
    #[command(flatten)]
    pub(crate) gpu: GpuArgs,
}

/// Which adapter renders.
#[derive(Args, Debug, Clone)]
pub(crate) struct GpuArgs {
    /// Adapter by (part of) its name; `umbrage list adapters` shows them.
    #[arg(long, value_name = "NAME", env = "WGPU_ADAPTER_NAME")]
    pub(crate) adapter: Option<String>,
    /// Graphics interface: vulkan, metal or dx12.
    #[arg(long, value_name = "NAME", env = "WGPU_BACKEND")]
    pub(crate) backend: Option<String>,
}

/// Where truth is found.
#[derive(Args, Debug, Clone, Copy)]
pub(crate) struct TruthArgs {
    /// Where truth is found. The GPU's V (scanlines alone) differs from the CPU's where a silhouette passes
    /// within rounding of a sample; irradiance is the CPU's.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) reference_on: ReferenceOn,
}

#[derive(ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum ReferenceOn {
    /// The adapter that renders, software too.
    Gpu,
    /// All cores.
    Cpu,
    /// A GPU where there is one, but never a software adapter.
    #[default]
    Auto,
}

#[derive(Args, Debug)]
pub(crate) struct EvaluateArgs {
    /// A suite file, scene names, scene folders or model files; the standard suite otherwise.
    pub(crate) what: Vec<PathBuf>,
    /// Scene by name (several by repeating): narrows a suite down.
    #[arg(long = "scene", value_name = "NAME")]
    pub(crate) scenes: Vec<String>,
    /// Variant by name, `chss` or `chss/as-printed` (several by repeating), or `all`; those of the suite
    /// otherwise.
    #[arg(long = "variant", value_name = "NAME")]
    pub(crate) variants: Vec<String>,
    #[command(flatten)]
    pub(crate) own: TechniqueArgs,
    /// Frames of each path; windows of 16 (fewer: one window; 1: temporal cells are not measured).
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) frames: Option<u32>,
    /// Pattern seeds per frame.
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u32).range(2..=64))]
    pub(crate) seeds: Option<u32>,
    /// Light samples of truth in each of its two halves.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub(crate) samples: Option<u32>,
    /// Standard error of truth that is wanted at each point, e.g. 0.002: points that need it get more
    /// samples, up to 8192 in each half.
    #[arg(long, value_name = "ERROR", value_parser = parse_tolerance)]
    pub(crate) tolerance: Option<f32>,
    /// Small and coarse: an answer in seconds.
    #[arg(long)]
    pub(crate) quick: bool,
    /// First pattern seed: another number draws other patterns throughout.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) first_seed: u32,
    /// A fault to put in on purpose: what the gate's error rates are measured with.
    #[arg(long, value_enum, hide = true)]
    pub(crate) plant: Option<Plant>,
    /// Compare with this baseline, and fail on a regression: a name under `--baselines`, or a file.
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
    /// Folder of cached truth and results.
    #[arg(long, value_name = "DIR", default_value = "reports/out/cache")]
    pub(crate) cache: PathBuf,
    /// Print the scorecard to standard output, and nothing else there.
    #[arg(long)]
    pub(crate) json: bool,
    /// Bias of all variants: metres, texels of normal offset, and the steepest receiver plane that is
    /// followed (or `off`), as in `0.001,0.5,5`.
    #[arg(long, value_name = "M,TEXELS,SLOPE", value_parser = parse_bias)]
    pub(crate) bias: Option<Bias>,
    /// Also write each variant's frames as EXR under the run.
    #[arg(long)]
    pub(crate) keep_frames: bool,
    /// Where the report's pictures go: `file` (into the page) or `dir` (beside it).
    #[arg(long, value_enum, default_value_t)]
    pub(crate) report: ReportKind,
    #[command(flatten)]
    pub(crate) truth: TruthArgs,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
}

#[derive(ValueEnum, Clone, Copy, Debug, Default)]
pub(crate) enum ReportKind {
    /// One self-contained page.
    #[default]
    File,
    /// A page with its pictures beside it.
    Dir,
}

#[derive(Args, Debug)]
pub(crate) struct ClaimsArgs {
    /// Claims by id (`C7`); all otherwise.
    pub(crate) claims: Vec<String>,
    /// Picture size of scores.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Picture size of costs.
    #[arg(long, value_name = "WxH", value_parser = parse_size, default_value = "1920x1080")]
    pub(crate) cost_size: (u32, u32),
    /// Pattern seeds per frame.
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u32).range(2..=64))]
    pub(crate) seeds: Option<u32>,
    /// Light samples of truth in each of its two halves.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub(crate) samples: Option<u32>,
    /// Side of the shadow map in texels, where a claim says nothing else.
    #[arg(long, value_name = "TEXELS", default_value_t = 2048)]
    pub(crate) map: u32,
    /// Small and coarse: an answer in minutes.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Costs measured before; otherwise this GPU's, or on a software adapter reports/gpu/claims-cost.json.
    #[arg(long, value_name = "FILE")]
    pub(crate) costs: Option<PathBuf>,
    /// A file of claims, in place of those that are built in.
    #[arg(long, value_name = "FILE")]
    pub(crate) registry: Option<PathBuf>,
    /// Folder of the pages.
    #[arg(long, value_name = "DIR", default_value = "reports/out/claims")]
    pub(crate) out: PathBuf,
    /// Folder of cached truth and results.
    #[arg(long, value_name = "DIR", default_value = "reports/out/cache")]
    pub(crate) cache: PathBuf,
    /// Also put the table, the crops and new costs into this folder, to be committed.
    #[arg(long, value_name = "DIR")]
    pub(crate) publish: Option<PathBuf>,
    /// Print claims.json to standard output, and nothing else there.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) truth: TruthArgs,
    #[command(flatten)]
    pub(crate) gpu: GpuArgs,
}

#[derive(Args, Debug)]
pub(crate) struct RenderArgs {
    /// A scene name, folder or model file.
    pub(crate) scene: PathBuf,
    /// Variant: `chss` or `chss/as-printed` (several by repeating).
    #[arg(long = "variant", value_name = "NAME", required_unless_present = "techniques")]
    pub(crate) variants: Vec<String>,
    #[command(flatten)]
    pub(crate) own: TechniqueArgs,
    /// First frame of the path.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) frame: u32,
    /// How many frames.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) frames: u32,
    /// Write every intermediate target as well.
    #[arg(long)]
    pub(crate) dump: bool,
    /// Folder of the EXR files.
    #[arg(long, value_name = "DIR", default_value = "frames")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) view: ViewArgs,
}

#[derive(Args, Debug)]
pub(crate) struct ReportArgs {
    /// Folder of a run.
    pub(crate) run: PathBuf,
    /// Where the report's pictures go: `file` (into the page) or `dir` (beside it).
    #[arg(long, value_enum, default_value_t)]
    pub(crate) report: ReportKind,
}

#[derive(Args, Debug)]
pub(crate) struct ListArgs {
    /// Of what.
    #[arg(value_enum)]
    pub(crate) what: Listed,
    /// Paths or lights of this scene alone: a built-in one, scene.toml, OBJ or glTF.
    #[arg(long, value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) own: TechniqueArgs,
    /// As JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(ValueEnum, Clone, Copy, Debug)]
pub(crate) enum Listed {
    Scenes,
    Paths,
    /// With the number that --light takes.
    Lights,
    Variants,
    Metrics,
    Adapters,
}
