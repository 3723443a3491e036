//! The main job: window by window, variant by variant, from truth to a stored run.

pub(crate) mod cost;
pub(crate) mod elsewhere;
mod extras;
mod measure;
pub(crate) mod panel;
mod pictures;
mod plant;
pub(crate) mod provenance;
mod scorecard;
pub(crate) mod sums;
pub(crate) mod truths;
pub(crate) mod unit;
pub(crate) mod window;

use crate::clock::Now;
use crate::error::CliError;
use crate::interrupt;
use crate::progress::Progress;
use crate::suite::{Job, Plan};
use cost::{CostOf, measure_cost};
use measure::Measured;
use std::path::PathBuf;
use umbrage_metrics::Bootstrap;
use umbrage_reference::{Cache, Finder, Tracer, TruthGpu};
use umbrage_report::{RunWriter, SUMS, Scorecard};
use umbrage_shadows::{Bias, Gpu, Renderer, VariantId};
use window::Window;

/// Where things go, and what is kept beside the report.
pub(crate) struct Settings {
    /// What finds truth, where it is not the CPU.
    pub(crate) truth_gpu: Option<TruthGpu>,
    pub(crate) cache: PathBuf,
    pub(crate) out: PathBuf,
    pub(crate) map_texels: u32,
    pub(crate) keep_frames: bool,
    /// In place of the calibrations' own, for all variants.
    pub(crate) bias: Option<Bias>,
    pub(crate) command: String,
    pub(crate) now: Now,
}

/// A window with what every variant did in it.
pub(crate) struct Scored {
    pub(crate) window: window::Facts,
    /// In the plan's order.
    pub(crate) variants: Vec<Measured>,
}

/// Share of surfaces on which truth and raster may disagree in one and the same frame. Silhouettes
/// make at most 4e-4 of a picture of 320x180; a field of view wrong by 1 % makes .89.
pub(crate) const DISAGREEMENT_LIMIT: f64 = 0.02;

/// The work in progress.
struct Run<'a> {
    plan: &'a Plan,
    settings: &'a Settings,
    cache: Cache,
    units: unit::Units,
    writer: RunWriter,
    progress: Progress,
    bootstrap: Bootstrap,
    windows_done: usize,
    /// Hash of this very program.
    program: String,
}

/// Runs a plan and stores the run; pages are made from it afterwards.
///
/// Returns the scorecard and what the user should be warned of.
pub(crate) fn evaluate(
    plan: &Plan,
    settings: &Settings,
    gpu: &mut Gpu,
) -> Result<(Scorecard, Vec<String>), CliError> {
    let writer = RunWriter::create(&settings.out)?;
    let mut run = Run {
        plan,
        settings,
        cache: Cache::open(settings.cache.join("truth"))?,
        units: unit::Units::open(&settings.cache.join("units"))?,
        writer,
        progress: Progress::new(steps(plan)),
        bootstrap: Bootstrap::default(),
        windows_done: 0,
        program: unit::program_hash(),
    };
    let (mut scored, mut costs) = (Vec::new(), Vec::new());
    for entry in &plan.jobs {
        run.scene(entry, gpu, (&mut scored, &mut costs))?;
    }
    run.progress.finish();
    keep_made_files(plan, settings)?;
    let card = scorecard::assemble(
        provenance::provenance(plan, settings, gpu),
        scorecard::Subjects::of(plan, &costs, gpu),
        &scored,
        &run.bootstrap,
    )?;
    let names = plan.variants.iter().map(VariantId::name).collect();
    sums::of((names, plan.margins.clone()), &card.provenance, &scored).save(&settings.out.join(SUMS))?;
    let warnings = warnings(&scored);
    run.writer.finish(&card)?;
    if scored.iter().all(|s| s.window.coverage.counted == 0) {
        let first =
            scored.first().map(|s| format!("{}, {}", s.window.scene, s.window.path)).unwrap_or_default();
        return Err(CliError::NothingScored(format!(
            "no surface point was seen by truth and raster alike ({first})"
        )));
    }
    if scored.iter().all(|s| s.variants.is_empty()) {
        return Err(CliError::NothingScored(warnings.join("; ")));
    }
    Ok((card, warnings))
}

/// The scene files of bare models, for the user to edit: `scene.toml`, or one a model.
fn keep_made_files(plan: &Plan, settings: &Settings) -> Result<(), CliError> {
    let made: Vec<_> =
        plan.jobs.iter().filter_map(|j| Some((&j.scene.name, j.made_file.as_ref()?))).collect();
    for (name, file) in &made {
        let path = match made.len() {
            1 => settings.out.join("scene.toml"),
            _ => settings.out.join(safe_name(name)).with_extension("scene.toml"),
        };
        std::fs::write(&path, file.to_toml()).map_err(CliError::file(&path))?;
    }
    Ok(())
}

/// Safe as a file name, whatever a scene is called.
pub(crate) fn safe_name(name: &str) -> String {
    name.chars()
        .map(|c| if c.is_ascii_alphanumeric() || "-_.+".contains(c) { c } else { '-' })
        .take(60)
        .collect()
}

/// Truth counts as one variant.
fn steps(plan: &Plan) -> u64 {
    let windows = u64::from((plan.frames / plan.sampling.window).max(1));
    let paths: usize = plan.jobs.iter().map(|j| j.paths.len()).sum();
    paths as u64 * windows * (1 + plan.variants.len() as u64)
}

fn warnings(scored: &[Scored]) -> Vec<String> {
    let place = |s: &Scored| format!("{}, {}", s.window.scene, s.window.path);
    let empty = scored.iter().filter(|s| s.window.coverage.counted == 0);
    let mut all: Vec<String> =
        empty.map(|s| format!("{}: no anchors agreed in this view: check the camera", place(s))).collect();
    all.extend(scored.iter().flat_map(|s| s.window.notes.iter().map(move |n| format!("{}: {n}", place(s)))));
    all
}

impl Run<'_> {
    fn scene(
        &mut self,
        entry: &Job,
        gpu: &mut Gpu,
        (scored, costs): (&mut Vec<Scored>, &mut Vec<CostOf>),
    ) -> Result<(), CliError> {
        let scene = &entry.scene;
        for note in &scene.notes {
            self.progress.note(&format!("{}: {note}", scene.name));
        }
        let tracer = Tracer::new(scene)?;
        let mut finder = Finder::new(&tracer, self.settings.truth_gpu.as_ref())?;
        let software = gpu.description().is_software();
        let adapter_key = format!("{:?} {}", gpu.description(), self.program);
        let mut renderer = Renderer::new(gpu, scene, self.settings.map_texels)?;
        if let Some(bias) = self.settings.bias {
            renderer.set_bias(bias);
        }
        for name in &entry.paths {
            let path = scene.path(name)?;
            let window_frames = self.plan.sampling.window.min(path.frames.len() as u32);
            let usable = (path.frames.len() as u32).min(self.plan.frames);
            let windows = usable / window_frames;
            // From the middle of the path: what a path is made for grows or shows there.
            let start = (path.frames.len() as u32 - windows * window_frames) / 2;
            for first in (0..windows).map(|w| start + w * window_frames) {
                let frames = &path.frames[first as usize..(first + window_frames) as usize];
                self.progress.say(format!("{}, {name}: truth", scene.name));
                let request =
                    window::Request { scene, path, first, step: 1, frames, readings: window::Readings::Both };
                let window = Window::new(
                    &request,
                    (&mut finder, &self.cache, Some(&mut renderer)),
                    &self.plan.sampling,
                )?;
                self.progress.advance(1);
                let refused = window.disagreement() > DISAGREEMENT_LIMIT;
                let variants = if refused {
                    self.refuse(&window)?
                } else {
                    self.window(&window, &mut renderer, &adapter_key)?
                };
                if !software && !refused {
                    renderer.set_past(window.past(window.middle()));
                    costs.extend(measure_cost(&mut renderer, window.middle_frame(), &self.plan.variants)?);
                }
                let mut facts = window.facts(path);
                if refused {
                    facts.notes.push(format!(
                        "not scored: truth and raster see different surfaces at {:.1} % of the points (limit {:.0} %)",
                        100.0 * window.disagreement(),
                        100.0 * DISAGREEMENT_LIMIT
                    ));
                }
                scored.push(Scored { window: facts, variants });
                interrupt::check(&self.settings.cache)?;
            }
            if let (Some(last), left @ 1..) = (scored.last_mut(), usable % window_frames) {
                last.window.notes.push(format!("{left} more frames do not fill a window and are not scored"));
            }
        }
        Ok(())
    }

    /// A window whose witnesses disagree: shown, not scored.
    fn refuse(&mut self, window: &Window) -> Result<Vec<Measured>, CliError> {
        self.writer.window_pictures(self.windows_done, &pictures::window(window))?;
        self.windows_done += 1;
        self.progress.advance(self.plan.variants.len() as u64);
        Ok(Vec::new())
    }

    /// All variants of one window.
    fn window(
        &mut self,
        window: &Window,
        renderer: &mut Renderer<'_>,
        adapter: &str,
    ) -> Result<Vec<Measured>, CliError> {
        let index = self.windows_done;
        self.writer.window_pictures(index, &pictures::window(window))?;
        let map = renderer.light_map(&window.frames[window.middle()].1);
        renderer.set_anchors(&plant::anchors(self.plan.sampling.plant, &window.anchors, &map))?;
        let mut variants = Vec::new();
        for (place, &variant) in self.plan.variants.iter().enumerate() {
            interrupt::check(&self.settings.cache)?;
            self.progress.say(format!("{}, {}: {}", window.scene, window.path, variant.name()));
            let key = unit::key(window, variant, (renderer, &self.plan.sampling, adapter))?;
            let measured = match self.units.read(&key) {
                Some(stored) => stored,
                None => {
                    if self.units.discard_damaged(&key) {
                        let place = format!("{}, {}, {}", window.scene, window.path, variant.name());
                        self.progress.note(&format!(
                            "warning: {place}: a cached result was damaged; it is measured again"
                        ));
                    }
                    let fresh = measure::measure(window, variant, renderer, &self.plan.sampling)?;
                    self.units.write(&key, &fresh);
                    fresh
                }
            };
            self.writer.variant_pictures(index, place, &measured.pictures)?;
            if self.settings.keep_frames {
                pictures::keep_frames(&self.settings.out, window, (variant, renderer))?;
            }
            variants.push(measured.without_pictures());
            self.progress.advance(1);
        }
        self.windows_done += 1;
        Ok(variants)
    }
}
