//! `umbrage evaluate`: the main job.

use super::{check_masks, gate, open_gpu, open_truth_gpu};
use crate::args::{EvaluateArgs, ReportKind};
use crate::clock;
use crate::error::CliError;
use crate::output::print;
use crate::run::provenance::adapter_card;
use crate::run::{Settings, evaluate};
use crate::shell;
use crate::suite::Plan;
use std::path::{Path, PathBuf};
use std::time::Duration;
use umbrage_report::{Layout, write_report};
use umbrage_shadows::Gpu;

pub(crate) fn run(args: &EvaluateArgs) -> Result<(), CliError> {
    let plan = Plan::new(args)?;
    check_masks(args.truth.reference_on, plan.jobs.iter().map(|job| &job.scene))?;
    args.save_baseline.as_deref().map_or(Ok(()), gate::check_name)?;
    let now = clock::now();
    let out = args.out.clone().unwrap_or_else(|| run_folder(&plan.name, &now.folder));
    let mut gpu = open_gpu(&args.view.gpu)?;
    gpu.set_patience(Duration::from_secs(args.own.patience));
    missing_baseline(args, &gpu)?;
    eprintln!("adapter: {} ({})", gpu.description().name, gpu.description().device_type);
    let truth_gpu = open_truth_gpu(args.truth.reference_on, &args.view.gpu)?;
    let settings = Settings {
        truth_gpu,
        cache: args.cache.clone(),
        out: out.clone(),
        map_texels: args.view.map,
        keep_frames: args.keep_frames,
        bias: args.bias,
        command: command_line(),
        now,
    };
    let outcome = evaluate(&plan, &settings, &mut gpu);
    // A run that scored nothing still has pictures that show why; one that broke off has at most the
    // scorecard of an earlier run in its folder.
    let stored = matches!(outcome, Ok(_) | Err(CliError::NothingScored(_)));
    let pages = stored.then(|| pages(&out, args.report)).transpose()?;
    let (card, warnings) = outcome?;
    for warning in warnings.iter().chain(pages.iter().flat_map(|p| &p.warnings)) {
        eprintln!("warning: {warning}");
    }
    if args.json {
        print(card.to_json()?.trim_end())?;
    }
    if let Some(written) = pages {
        eprintln!("report: {}", written.index.display());
    }
    let names = (args.baseline.as_ref(), args.save_baseline.as_ref());
    gate::after_run(&out, names, &args.gate, (args.report, args.json))
}

/// A baseline that is not there is said before the work, not after it.
fn missing_baseline(args: &EvaluateArgs, gpu: &Gpu) -> Result<(), CliError> {
    let Some(name) = &args.baseline else { return Ok(()) };
    gate::place_of(name, &adapter_card(gpu), &args.gate.baselines).map(|_| ())
}

fn pages(out: &Path, kind: ReportKind) -> Result<umbrage_report::Written, CliError> {
    Ok(write_report(out, layout(kind))?)
}

/// Where the report's pictures go.
pub(super) fn layout(kind: ReportKind) -> Layout {
    match kind {
        ReportKind::File => Layout::SingleFile,
        ReportKind::Dir => Layout::Folder,
    }
}

/// Safe as a folder name whatever the suite is called.
pub(super) fn run_folder(name: &str, date: &str) -> PathBuf {
    let safe: String = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() || "-_.+".contains(c) { c } else { '-' })
        .take(60)
        .collect();
    Path::new("reports/out").join(format!("{safe}-{date}"))
}

/// The command to copy: the program's own name, not where it lies on this machine.
pub(super) fn command_line() -> String {
    shell::line(std::iter::once("umbrage".to_string()).chain(std::env::args().skip(1)))
}
