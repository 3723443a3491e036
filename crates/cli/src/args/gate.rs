//! Arguments of the gate.

use super::ReportKind;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Faults that a gate has to find (docs/ci.md).
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Plant {
    /// The shadow map is looked up half a texel off.
    HalfTexel,
    /// The frame in the middle of each window has no shadows.
    BrokenFrame,
    /// Variants take the light for 2 % smaller than it is.
    NarrowPenumbra,
}

/// How the gate answers.
#[derive(Args, Debug, Clone)]
pub(crate) struct GateArgs {
    /// Folder of baselines.
    #[arg(long, value_name = "DIR", default_value = "reports/baselines")]
    pub(crate) baselines: PathBuf,
    /// What exits with 1.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) fail_on: FailOn,
}

#[derive(ValueEnum, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum FailOn {
    /// A score that got worse.
    #[default]
    Regression,
    /// Also one that may have, and what the baseline does not know.
    Warn,
    /// Nothing.
    Never,
}

#[derive(Args, Debug)]
pub(crate) struct CompareArgs {
    /// The baseline: a name under `--baselines`, a file, or the folder of a run.
    pub(crate) base: String,
    /// Folder of the run.
    pub(crate) run: PathBuf,
    /// Print gate.json to standard output, and nothing else there.
    #[arg(long)]
    pub(crate) json: bool,
    /// Where the report's pictures go: `file` (into the page) or `dir` (beside it).
    #[arg(long, value_enum, default_value_t)]
    pub(crate) report: ReportKind,
    #[command(flatten)]
    pub(crate) gate: GateArgs,
}

#[derive(Args, Debug)]
pub(crate) struct AcceptArgs {
    /// Folder of the run.
    pub(crate) run: PathBuf,
    /// Name of the baseline; that of the run's gate otherwise.
    #[arg(long, value_name = "NAME")]
    pub(crate) name: Option<String>,
    /// Folder of baselines.
    #[arg(long, value_name = "DIR", default_value = "reports/baselines")]
    pub(crate) baselines: PathBuf,
}
