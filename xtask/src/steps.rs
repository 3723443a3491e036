//! The commands, each a list of steps.

use crate::{adapter, browser, layers};
use std::process::Command;
use std::sync::atomic::{AtomicU8, Ordering};

/// Exit code of the step that failed.
static LAST: AtomicU8 = AtomicU8::new(1);

/// What to exit with after a failure.
pub(crate) fn last_exit_code() -> u8 {
    LAST.load(Ordering::Relaxed)
}

/// A step's outcome: what failed, in words.
pub(crate) type Outcome = Result<(), String>;

/// Runs a program and says what it was when it fails.
pub(crate) fn run(program: &str, arguments: &[&str]) -> Outcome {
    run_in(Command::new(program).args(arguments))
}

fn run_in(command: &mut Command) -> Outcome {
    let shown = std::iter::once(command.get_program()).chain(command.get_args());
    let shown = shown.map(|a| a.to_string_lossy().into_owned()).collect::<Vec<_>>().join(" ");
    eprintln!("> {shown}");
    let status = command.status().map_err(|e| format!("{shown}: {e}"))?;
    if status.success() {
        return Ok(());
    }
    LAST.store(status.code().and_then(|c| u8::try_from(c).ok()).unwrap_or(1), Ordering::Relaxed);
    Err(format!("failed ({status}): {shown}"))
}

/// Cargo, as it called us.
pub(crate) fn cargo() -> String {
    std::env::var("CARGO").unwrap_or_else(|_| "cargo".into())
}

/// Builds and runs the main job.
pub(crate) fn evaluate(arguments: &[String]) -> Outcome {
    run(&cargo(), &["build", "--release", "--package", "umbrage"])?;
    let program = adapter::program("release")?;
    adapter::ensure(&program)?;
    let mut command = Command::new(&program);
    run_in(adapter::quiet(command.arg("evaluate").args(arguments)))
}

/// The README's pictures: where they come from in a run's folder, and what they are called.
const FIGURES: [(&str, &str); 7] = [
    ("window-00-truth.png", "truth.png"),
    ("window-00-variant-00-shadow.png", "chss-mask-shadow.png"),
    ("window-00-variant-00-error.png", "chss-mask-error.png"),
    ("window-00-variant-00-swim.png", "chss-mask-swim.png"),
    ("window-00-variant-01-shadow.png", "chss-min-shadow.png"),
    ("window-00-variant-01-error.png", "chss-min-error.png"),
    ("window-00-variant-01-swim.png", "chss-min-swim.png"),
];

/// Renders the pictures of the README and of docs/techniques.md again.
pub(crate) fn figures() -> Outcome {
    let variants = ["--variant", "chss-mask/light-matched", "--variant", "chss-min/light-matched"];
    let run =
        ["colonnade", "--path", "P4", "--size", "480x270", "--report", "dir", "--out", "reports/out/figures"];
    evaluate(&run.into_iter().chain(variants).map(str::to_string).collect::<Vec<_>>())?;
    for (from, to) in FIGURES {
        copy(("reports/out/figures", from), ("reports/figures", to))?;
    }
    let all = listed_variants()?;
    let placed = |(_, line): &&(String, String)| line.contains("lights that have a place");
    let (rooms, suns): (Vec<_>, Vec<_>) = all.iter().partition(placed);
    pictures("colonnade", &suns)?;
    pictures("point-light-room", &rooms)
}

/// Takes the README's pictures of the page again: of the standard suite, or of a stored run.
pub(crate) fn screenshots(arguments: &[String]) -> Outcome {
    browser::ensure()?;
    let own = "reports/out/screenshots".to_string();
    let run_folder = arguments.first().unwrap_or(&own);
    if arguments.is_empty() {
        evaluate(&["--reference-on", "cpu", "--out", &own].map(str::to_string))?;
    }
    // The packages of the workspace's own build, so that nothing is compiled twice.
    run(&cargo(), &["build", "--workspace", "--example", "screenshots"])?;
    let example = adapter::program("debug")?.with_file_name("examples").join("screenshots");
    run_in(Command::new(example).args([run_folder, "reports/figures"]))
}

/// Names of all variants, each with its line of the list.
fn listed_variants() -> Result<Vec<(String, String)>, String> {
    let output = Command::new(adapter::program("release")?)
        .args(["list", "variants"])
        .output()
        .map_err(|e| format!("umbrage list variants: {e}"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let name = |line: &str| Some((line.split_whitespace().next()?.to_string(), line.to_string()));
    Ok(text.lines().skip(1).filter_map(name).collect())
}

/// A small picture of each variant, light-matched, and of the truth beside them.
fn pictures(scene: &str, variants: &[&(String, String)]) -> Outcome {
    let out = format!("reports/out/techniques-{scene}");
    let run =
        [scene, "--path", "P1", "--size", "240x135", "--frames", "2", "--seeds", "2", "--samples", "64"];
    let mut arguments: Vec<String> = run.map(str::to_string).to_vec();
    arguments.extend(["--report", "dir", "--out", &out].map(str::to_string));
    for (name, _) in variants {
        arguments.extend(["--variant".to_string(), format!("{name}/light-matched")]);
    }
    evaluate(&arguments)?;
    copy((&out, "window-00-truth.png"), ("docs/techniques", &format!("truth-{scene}.png")))?;
    for (index, (name, _)) in variants.iter().enumerate() {
        let picture = format!("window-00-variant-{index:02}-shadow.png");
        copy((&out, &picture), ("docs/techniques", &format!("{name}.png")))?;
    }
    Ok(())
}

/// A picture of a run to where it is committed.
fn copy((run, from): (&str, &str), (folder, to): (&str, &str)) -> Outcome {
    std::fs::create_dir_all(folder).map_err(|e| format!("{folder}: {e}"))?;
    let (from, to) = (format!("{run}/index_files/{from}"), format!("{folder}/{to}"));
    std::fs::copy(&from, &to).map(|_| ()).map_err(|e| format!("{from}: {e}"))
}

/// All tests, documentation examples included.
pub(crate) fn test() -> Outcome {
    run(&cargo(), &["build", "--workspace", "--bins"])?;
    adapter::ensure(&adapter::program("debug")?)?;
    let mut command = Command::new(cargo());
    run_in(adapter::quiet(command.args(["test", "--workspace", "--no-fail-fast"])))
}

/// The report's page in a browser: apart from `test`, which needs nothing but Rust and an adapter.
pub(crate) fn page() -> Outcome {
    browser::ensure()?;
    // The packages of the workspace's own build, so that nothing is compiled twice.
    let test = ["test", "--workspace", "--test", "page", "--", "--ignored", "--test-threads", "2"];
    run(&cargo(), &test)
}

/// Everything that a change must pass.
pub(crate) fn ci() -> Outcome {
    run(&cargo(), &["fmt", "--all", "--check"])?;
    layers::check()?;
    single_versions()?;
    run(&cargo(), &["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"])?;
    let mut doc = Command::new(cargo());
    run_in(doc.args(["doc", "--workspace", "--no-deps", "--quiet"]).env("RUSTDOCFLAGS", "-D warnings"))?;
    test()?;
    match browser::ensure() {
        Ok(()) => page()?,
        // Not a fault of the change: said loudly, so that nobody takes it for a pass.
        Err(e) => eprintln!("WARNING: no browser could be installed; THE PAGE WAS NOT TESTED: {e}"),
    }
    gate()
}

/// The committed baseline of the standard suite: `umbrage evaluate --reference-on cpu --save-baseline standard`
/// renews it.
fn gate() -> Outcome {
    let mut command = Command::new(adapter::program("debug")?);
    let arguments = ["evaluate", "--baseline", "standard", "--reference-on", "cpu"];
    let places = ["--cache", "target/gate/cache", "--out", "target/gate/run"];
    run_in(adapter::quiet(command.args(arguments).args(places)))
}

/// Types of two copies of these do not match each other.
const ONCE: [&str; 4] = ["glam", "wgpu", "naga", "exr"];

fn single_versions() -> Outcome {
    let output = Command::new(cargo())
        .args(["tree", "--workspace", "--duplicates", "--depth", "0"])
        .output()
        .map_err(|e| format!("cargo tree: {e}"))?;
    let tree = String::from_utf8_lossy(&output.stdout);
    match ONCE.iter().find(|name| tree.lines().any(|line| line.starts_with(&format!("{name} v")))) {
        Some(name) => {
            Err(format!("two versions of {name} in the tree: `cargo tree -d` shows who wants which"))
        }
        None => Ok(()),
    }
}

/// Renews goldens; look at the difference before committing it.
pub(crate) fn bless() -> Outcome {
    run(&cargo(), &["build", "--package", "umbrage"])?;
    let packages = ["--package", "umbrage-report", "--package", "umbrage-tests"];
    let mut command = Command::new(cargo());
    run_in(adapter::quiet(command.arg("test").args(packages).args(["scorecard"]).env("UMBRAGE_BLESS", "1")))
}
