//! How often the gate fails an unchanged build, and how often it finds a planted fault.
//!
//! `cargo run --release -p umbrage-tests --example gate_rates -- --umbrage FILE [--runs 200] [--planted 20]
//! [--jobs 1]
//! [--out reports/gate.md] [-- ARGUMENTS of umbrage evaluate]`. Every run draws other pattern seeds than the
//! baseline. Faults that are another variant's setting are judged by giving that variant's sums the name of the
//! sound one; the others are put in by `--plant` and `--bias`.
#![expect(clippy::print_stdout, reason = "a program that talks to people")]

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};
use umbrage_metrics::Verdict;
use umbrage_report::{Baseline, GateCard, compare};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// What is run: the sound variants and those that stand for a fault.
const VARIANTS: [&str; 9] = [
    "pcf-vogel-16/light-matched",
    "pcf-vogel-16-ign/light-matched",
    "pcf-vogel-16-white/light-matched",
    "pcf-vogel-32-ign/light-matched",
    "chss/light-matched",
    "chss-mask/light-matched",
    "chss-mask-1.0/light-matched",
    "chss-mask-raw-1.2/light-matched",
    "chss-min/light-matched",
];

/// Faults that are another variant: name, the sound one, what stands for it.
const SWAPS: [(&str, &str, &str); 4] = [
    ("blur of the mask off", "chss-mask", "chss-mask-raw-1.2"),
    ("search scale 1.2 to 1.0", "chss-mask", "chss-mask-1.0"),
    ("32 to 16 taps", "pcf-vogel-32-ign", "pcf-vogel-16-ign"),
    ("IGN to white noise", "pcf-vogel-16-ign", "pcf-vogel-16-white"),
];

/// Faults that are put in: name, arguments.
const PLANTS: [(&str, &str); 4] = [
    ("bias doubled", "--bias BIAS"),
    ("lookups half a texel off", "--plant half-texel"),
    ("one frame of 16 broken", "--plant broken-frame"),
    ("penumbra 2 % narrower", "--plant narrow-penumbra"),
];

struct Options {
    umbrage: PathBuf,
    runs: u32,
    planted: u32,
    bias: String,
    out: PathBuf,
    work: PathBuf,
    jobs: u32,
    more: Vec<String>,
}

fn main() -> Outcome<()> {
    let options = options()?;
    let base = measure(&options, 0, "")?;
    let mut unchanged = Tally::default();
    let mut swaps: BTreeMap<&str, Tally> = BTreeMap::new();
    let mut least: BTreeMap<String, Vec<[f64; 2]>> = BTreeMap::new();
    for run in all(&options, options.runs, "")? {
        let card = compare(&base, &run)?;
        unchanged.add(&card);
        for (case, change) in card.cases.iter().filter_map(|c| Some((c, c.change?))) {
            if case.scene.is_none() {
                least.entry(case.metric.clone()).or_default().push([change.caught, change.base]);
            }
        }
        // Another variant's setting costs no run: it is judged in every one.
        for (name, sound, faulty) in SWAPS {
            let [base, run] = [renamed(&base, sound, sound), renamed(&run, faulty, sound)];
            swaps.entry(name).or_default().add(&compare(&base, &run)?);
        }
    }
    println!("unchanged: {} failed", unchanged.share());
    let mut plants = Vec::new();
    for (name, arguments) in PLANTS {
        let arguments = arguments.replace("BIAS", &options.bias);
        let mut tally = Tally::default();
        for run in &all(&options, options.planted, &arguments)? {
            tally.add(&compare(&base, run)?);
        }
        println!("{name}: caught {} of {}", tally.failed, tally.runs);
        plants.push((name, tally));
    }
    let text = page(&options, &base, &unchanged, &swaps, &plants, &least)?;
    std::fs::write(&options.out, text)?;
    println!("{}", options.out.display());
    Ok(())
}

/// Verdicts of several runs.
#[derive(Default)]
struct Tally {
    runs: u32,
    /// Runs that regressed somewhere.
    failed: u32,
    cases: usize,
    /// By score, in how many runs it regressed.
    scores: BTreeMap<String, u32>,
    inconclusive: usize,
}

impl Tally {
    fn add(&mut self, card: &GateCard) {
        self.runs += 1;
        self.cases += card.cases.iter().filter(|c| c.change.is_some()).count();
        self.inconclusive += card.with(Verdict::Inconclusive).count();
        let mut scores: Vec<&String> = card.with(Verdict::Regressed).map(|(case, _)| &case.metric).collect();
        self.failed += u32::from(!scores.is_empty());
        scores.sort();
        scores.dedup();
        for score in scores {
            *self.scores.entry(score.clone()).or_default() += 1;
        }
    }

    fn share(&self) -> String {
        format!(
            "{} of {} ({:.1} %)",
            self.failed,
            self.runs,
            100.0 * f64::from(self.failed) / f64::from(self.runs.max(1))
        )
    }

    fn by(&self) -> String {
        let part = |(score, runs): (&String, &u32)| format!("{} {runs}", score.replace('_', " "));
        self.scores.iter().map(part).collect::<Vec<_>>().join(", ")
    }
}

/// Runs of the seeds from 1, several at a time.
fn all(options: &Options, runs: u32, fault: &str) -> Outcome<Vec<Baseline>> {
    let next = AtomicU32::new(1);
    let done = Mutex::new(BTreeMap::new());
    std::thread::scope(|scope| {
        for _ in 0..options.jobs {
            scope.spawn(|| {
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if seed > runs {
                        break;
                    }
                    let run = measure(options, seed, fault).map_err(|e| e.to_string());
                    if let Ok(mut done) = done.lock() {
                        done.insert(seed, run);
                        println!("{fault} {} of {runs}", done.len());
                    }
                }
            });
        }
    });
    let done = done.into_inner().map_err(|e| e.to_string())?;
    Ok(done.into_values().collect::<Result<_, _>>()?)
}

fn measure(options: &Options, seed: u32, fault: &str) -> Outcome<Baseline> {
    // Truth is shared; results of other seeds are never asked for again.
    let out = options.work.join(format!("run-{seed}"));
    let mut command = Command::new(&options.umbrage);
    command.args(["evaluate", "--report", "dir", "--first-seed", &seed.to_string()]);
    command.args([
        "--cache".as_ref(),
        options.work.join("cache").as_os_str(),
        "--out".as_ref(),
        out.as_os_str(),
    ]);
    for variant in VARIANTS {
        command.args(["--variant", variant]);
    }
    command.args(fault.split_whitespace()).args(&options.more);
    let done = command.output()?;
    if !done.status.success() {
        return Err(format!("{command:?}: {}", String::from_utf8_lossy(&done.stderr)).into());
    }
    let sums = Baseline::load(&out.join("sums.json"))?;
    std::fs::remove_dir_all(&out)?;
    Ok(sums)
}

/// One variant under another name.
fn renamed(baseline: &Baseline, from: &str, to: &str) -> Baseline {
    only(baseline, |name| {
        let (variant, calibration) = name.split_once('/')?;
        (variant == from).then(|| format!("{to}/{calibration}"))
    })
}

fn only(baseline: &Baseline, name: impl Fn(&str) -> Option<String>) -> Baseline {
    let kept: Vec<(usize, String)> =
        baseline.variants.iter().enumerate().filter_map(|(i, v)| Some((i, name(v)?))).collect();
    let mut small = baseline.clone();
    small.variants = kept.iter().map(|k| k.1.clone()).collect();
    small.sums.retain_mut(|sums| {
        let place = kept.iter().position(|k| k.0 == sums.variant);
        sums.variant = place.unwrap_or_default();
        place.is_some()
    });
    small
}

fn page(
    options: &Options,
    base: &Baseline,
    unchanged: &Tally,
    swaps: &BTreeMap<&str, Tally>,
    plants: &[(&str, Tally)],
    least: &BTreeMap<String, Vec<[f64; 2]>>,
) -> Outcome<String> {
    let p = &base.provenance;
    let mut text = String::from("# How often the gate is wrong\n\n");
    writeln!(
        text,
        "Suite `{}` at {}x{}, T = {}, S = {}, {} windows, {} variants in {} cases a run; {}, umbrage {}, {}. Every run \
         draws other pattern seeds than the baseline.\n",
        p.suite,
        p.width,
        p.height,
        p.frames,
        p.seeds,
        base.windows.len(),
        base.variants.len(),
        unchanged.cases / unchanged.runs.max(1) as usize,
        p.adapter.name,
        p.tool_version,
        p.date
    )?;
    writeln!(
        text,
        "**An unchanged build failed {}**; {:.1} % of its cases were inconclusive.\n",
        unchanged.share(),
        100.0 * unchanged.inconclusive as f64 / unchanged.cases.max(1) as f64
    )?;
    writeln!(text, "| planted fault | caught | by score: runs |\n| --- | ---: | --- |")?;
    for (name, sound, faulty) in SWAPS {
        if let Some(tally) = swaps.get(name) {
            writeln!(text, "| {name} (`{faulty}` as `{sound}`) | {} | {} |", tally.share(), tally.by())?;
        }
    }
    for (name, tally) in plants {
        writeln!(text, "| {name} | {} | {} |", tally.share(), tally.by())?;
    }
    writeln!(
        text,
        "\nThe smallest harm that is caught 95 % of the time over all windows: median, least and most \
         over variants and runs; in the score's unit, and as part of the baseline.\n\n\
         | score | median | least | most | median, part |\n| --- | ---: | ---: | ---: | ---: |"
    )?;
    for (score, values) in least {
        let mut caught: Vec<f64> = values.iter().map(|v| v[0]).collect();
        let mut parts: Vec<f64> = values.iter().map(|v| v[0] / v[1].abs().max(1e-12)).collect();
        caught.sort_by(f64::total_cmp);
        parts.sort_by(f64::total_cmp);
        let middle = |v: &[f64]| v[v.len() / 2];
        writeln!(
            text,
            "| {} | {:.2e} | {:.2e} | {:.2e} | {:.1} % |",
            score.replace('_', " "),
            middle(&caught),
            caught[0],
            caught[caught.len() - 1],
            100.0 * middle(&parts)
        )?;
    }
    writeln!(
        text,
        "\nMade by `cargo run --release -p umbrage-tests --example gate_rates -- --umbrage target/release/umbrage --runs {} \
         --planted {}{}`.",
        options.runs,
        options.planted,
        if options.more.is_empty() { String::new() } else { format!(" -- {}", options.more.join(" ")) }
    )?;
    Ok(text)
}

fn options() -> Outcome<Options> {
    let mut options = Options {
        umbrage: "target/release/umbrage".into(),
        runs: 200,
        planted: 20,
        bias: "0.002,1,5".into(),
        out: "reports/gate.md".into(),
        work: std::env::temp_dir().join("umbrage-gate-rates"),
        jobs: 1,
        more: Vec::new(),
    };
    let mut all = std::env::args().skip(1);
    while let Some(argument) = all.next() {
        if argument == "--" {
            options.more = all.collect();
            break;
        }
        let value = all.next().ok_or(format!("{argument} needs a value"))?;
        match argument.as_str() {
            "--umbrage" => options.umbrage = Path::new(&value).canonicalize()?,
            "--runs" => options.runs = value.parse()?,
            "--planted" => options.planted = value.parse()?,
            "--bias" => options.bias = value,
            "--out" => options.out = value.into(),
            "--jobs" => options.jobs = value.parse()?,
            "--work" => options.work = value.into(),
            _ => return Err(format!("unknown argument {argument}").into()),
        }
    }
    Ok(options)
}
