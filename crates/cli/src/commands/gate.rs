//! `umbrage compare`, `umbrage accept`, and what `umbrage evaluate --baseline` does after a run.

use super::evaluate::layout;
use crate::args::{AcceptArgs, CompareArgs, FailOn, GateArgs, ReportKind};
use crate::error::CliError;
use crate::output::print;
use crate::run::elsewhere::subject_name;
use crate::shell;
use std::path::{Path, PathBuf};
use umbrage_metrics::Verdict;
use umbrage_report::{
    AdapterCard, Baseline, GateCard, GateCase, SUMS, compare, write_gate_crops, write_report,
};

/// `umbrage compare BASE RUN`.
pub(crate) fn compare_runs(args: &CompareArgs) -> Result<(), CliError> {
    let card = gate(&args.base, &args.run, &args.gate)?;
    let written = write_report(&args.run, layout(args.report))?;
    if args.json {
        let text = serde_json::to_string_pretty(&card);
        print(&text.map_err(|e| CliError::Usage(e.to_string()))?)?;
    }
    answer(&card, &args.gate, args.json)?;
    eprintln!("report: {}", written.index.display());
    outcome(&card, &args.gate)
}

/// `umbrage accept RUN`.
pub(crate) fn accept(args: &AcceptArgs) -> Result<(), CliError> {
    let gated = GateCard::load(&args.run)?;
    let name = args.name.clone().or_else(|| gated.map(|g| g.baseline)).ok_or_else(|| {
        CliError::Usage(format!(
            "{} was compared with no baseline: say which it becomes with --name",
            args.run.display()
        ))
    })?;
    print(&save(&args.run, &name, &args.baselines)?.display().to_string())
}

/// Makes a run the baseline of a name; where it lies.
pub(super) fn save(run: &Path, name: &str, baselines: &Path) -> Result<PathBuf, CliError> {
    check_name(name)?;
    let mut sums = Baseline::load(&run.join(SUMS))?;
    if sums.is_empty() {
        return Err(CliError::NothingScored(format!(
            "{} holds no sums: nothing to compare with",
            run.display()
        )));
    }
    if sums.sums.iter().any(|s| s.spread.is_empty()) {
        eprintln!(
            "warning: with {} seeds nothing is known about their spread; no run can be compared with this \
             baseline: make it with --seeds {FEWEST_SEEDS} or more (frames from elsewhere: as many takes, or --deterministic)",
            sums.provenance.seeds
        );
    }
    // A baseline is committed: where its run lay is nobody's business.
    sums.provenance.command = shell::without(&sums.provenance.command, &["--out", "--cache", "--baselines"]);
    std::fs::create_dir_all(baselines).map_err(CliError::file(baselines))?;
    let path = Baseline::path(baselines, name, &sums.provenance.adapter);
    sums.save(&path)?;
    Ok(path)
}

/// One without which nothing varies.
const FEWEST_SEEDS: u32 = 3;

/// A name that is safe as a part of a file's.
pub(super) fn check_name(name: &str) -> Result<(), CliError> {
    let safe = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c));
    match safe {
        true => Ok(()),
        false => {
            Err(CliError::Usage(format!("\"{name}\" is no name of a baseline: letters, digits, - and _ are")))
        }
    }
}

/// Judges a run, and stores what was found in its folder.
pub(super) fn gate(base: &str, run: &Path, args: &GateArgs) -> Result<GateCard, CliError> {
    let sums = Baseline::load(&run.join(SUMS))?;
    let place = place_of(base, &sums.provenance.adapter, &args.baselines)?;
    let (baseline, name) = (Baseline::load(&place)?, name_of(base));
    let mut card = compare(&baseline, &sums)?;
    card.baseline = name.clone();
    let folder = match args.baselines.to_str() {
        Some("reports/baselines") | None => String::new(),
        Some(other) => format!(" --baselines {}", shell::quoted(other)),
    };
    card.accept = format!("umbrage accept {} --name {name}{folder}", shell::quoted(&run.to_string_lossy()));
    let provenance = sums.provenance;
    for case in &mut card.cases {
        case.reproduce = reproduce(case, &provenance.command);
    }
    // The sums of a run lie beside its pictures; a committed baseline has none.
    let base_run = place.parent().filter(|_| place.ends_with(SUMS));
    write_gate_crops(run, base_run, &mut card)?;
    card.save(run)?;
    Ok(card)
}

/// The run's own command, narrowed down to one case.
fn reproduce(case: &GateCase, command: &str) -> Option<String> {
    let (scene, path) = (case.scene.as_ref()?, case.path.as_ref()?);
    if !command.starts_with("umbrage evaluate") {
        // Windows of frames from elsewhere have no flag; their variants have.
        let whole = shell::without(command, &["--baseline", "--save-baseline", "--out"]);
        let variant = case.variant.rsplit_once('/').map_or(case.variant.as_str(), |(name, _)| name);
        return Some(shell::keeping(&whole, "--frames", |value| subject_name(value) == variant));
    }
    let whole = ["--scene", "--path", "--variant", "--baseline", "--save-baseline", "--out"];
    let narrow = [("--scene", scene), ("--path", path), ("--variant", &case.variant)];
    let narrow = narrow.map(|(flag, value)| format!(" {flag} {}", shell::quoted(value)));
    Some(shell::without(command, &whole) + &narrow.concat())
}

/// Where a baseline lies that is given by name, as a file or as the folder of a run: names come first, for a
/// folder may happen to be called like one.
pub(super) fn place_of(base: &str, adapter: &AdapterCard, baselines: &Path) -> Result<PathBuf, CliError> {
    let (named, given) = (Baseline::path(baselines, base, adapter), PathBuf::from(base));
    let folder = given.join(SUMS);
    let found = [&named, &folder, &given].into_iter().find(|path| path.is_file());
    found.cloned().ok_or(CliError::NoBaseline { name: base.into(), path: named })
}

/// What to call a baseline, so that `accept` takes it: "standard.vulkan-llvmpipe.json" is "standard", "run 1" is "run-1".
fn name_of(base: &str) -> String {
    let stem = Path::new(base).file_stem().map_or_else(|| base.into(), |s| s.to_string_lossy());
    let safe = |c: char| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '-' };
    let name: String = stem.split('.').next().unwrap_or_default().chars().map(safe).collect();
    if name.is_empty() { "base".into() } else { name }
}

/// Says what was found, and marks it for GitHub where that is what runs this.
pub(super) fn answer(card: &GateCard, args: &GateArgs, quiet: bool) -> Result<(), CliError> {
    eprintln!("gate against {}: {}", card.baseline, card.counts());
    for (case, _) in card.with(Verdict::Regressed) {
        eprintln!("regressed: {}, {}: {}", case.place(), case.variant, case.sentence());
        for line in case.details(card) {
            eprintln!("  {line}");
        }
    }
    for change in &card.margins_changed {
        eprintln!("margin changed: {change}");
    }
    if !card.new.is_empty() {
        eprintln!("not in the baseline: {}", card.new.join(", "));
    }
    if std::env::var_os("GITHUB_ACTIONS").is_none() || quiet {
        return Ok(());
    }
    let level = if args.fail_on == FailOn::Never { "warning" } else { "error" };
    for (case, _) in card.with(Verdict::Regressed).take(MOST_ANNOTATIONS) {
        print(&annotation(level, case))?;
    }
    Ok(())
}

/// GitHub shows ten of a kind for a step.
const MOST_ANNOTATIONS: usize = 10;

/// A workflow command: what ends a property or the line is written as a percent code.
fn annotation(level: &str, case: &GateCase) -> String {
    let data = |text: &str| text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    let property = |text: &str| data(text).replace(':', "%3A").replace(',', "%2C");
    let title = format!("{} regressed: {}, {}", case.metric, case.place(), case.variant);
    format!("::{level} title={}::{}", property(&title), data(&case.sentence()))
}

/// An error where the gate is shut.
pub(super) fn outcome(card: &GateCard, args: &GateArgs) -> Result<(), CliError> {
    let regressed = card.with(Verdict::Regressed).count();
    let unsure = card.with(Verdict::Inconclusive).count() + card.new.len();
    let shut = match args.fail_on {
        FailOn::Never => false,
        FailOn::Regression => regressed > 0,
        FailOn::Warn => regressed + unsure > 0,
    };
    if !shut {
        return Ok(());
    }
    Err(CliError::Regressed(match regressed {
        0 => format!("{} against {} (--fail-on warn)", card.counts(), card.baseline),
        n => format!("{n} scores regressed against {}; to accept them: {}", card.baseline, card.accept),
    }))
}

/// After a run: the gate, then the pages with its answer, then the new baseline, unless the gate is shut.
pub(super) fn after_run(
    run: &Path,
    (baseline, save_as): (Option<&String>, Option<&String>),
    args: &GateArgs,
    (kind, quiet): (ReportKind, bool),
) -> Result<(), CliError> {
    let card = baseline.map(|base| gate(base, run, args)).transpose()?;
    if let Some(card) = &card {
        write_report(run, layout(kind))?;
        answer(card, args, quiet)?;
        outcome(card, args)?;
    }
    if let Some(name) = save_as {
        eprintln!("baseline: {}", save(run, name, &args.baselines)?.display());
    }
    Ok(())
}
