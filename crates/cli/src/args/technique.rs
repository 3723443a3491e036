//! Flags of a user's own techniques.

use clap::Args;
use std::path::PathBuf;

#[derive(Args, Debug, Clone)]
pub(crate) struct TechniqueArgs {
    /// A technique of your own, a WGSL file (several by repeating), beside the variants:
    /// docs/your-technique.md.
    #[arg(long = "technique", value_name = "FILE")]
    pub(crate) techniques: Vec<PathBuf>,
    /// Another value for a constant of a `--technique`, by the name in its header (several by
    /// repeating).
    #[arg(long = "set", value_name = "NAME.CONSTANT=VALUE", requires = "techniques")]
    pub(crate) sets: Vec<String>,
    /// Longest that the driver may take for a frame, in seconds; more is an error.
    #[arg(long, value_name = "SECS", default_value_t = 300, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    pub(crate) patience: u64,
}
