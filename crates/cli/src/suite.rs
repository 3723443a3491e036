//! What is evaluated: scenes with their paths, and how large and long.

use crate::args::{EvaluateArgs, Plant, check_size};
use crate::error::CliError;
use crate::own;
use crate::scenes::{family_of, find_lit_scene};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use umbrage_report::{MarginCard, Margins};
use umbrage_scene::{Scene, SceneFile, suggest};
use umbrage_shadows::{VARIANTS, VariantId, select_variants};

/// The standard suite, compiled in.
const STANDARD: &str = include_str!("../../../scenes/standard.toml");

/// A suite file.
#[derive(Deserialize, Debug, Clone)]
#[serde(deny_unknown_fields)]
struct SuiteFile {
    /// Names the run.
    name: String,
    /// Pixels: `[width, height]`.
    #[serde(default)]
    size: Option<[u32; 2]>,
    /// Variants by name, as for `--variant`; those of the standard suite when empty.
    #[serde(default)]
    variants: Vec<String>,
    /// What is too small to matter, by score.
    #[serde(default)]
    gate: BTreeMap<String, MarginCard>,
    /// Scenes and their paths.
    scene: Vec<SuiteScene>,
}

#[derive(Deserialize, Debug, Clone, Default)]
#[serde(deny_unknown_fields)]
struct SuiteScene {
    /// A standard scene, or a path beside the suite file.
    name: PathBuf,
    /// Paths through it; all of the scene's when empty.
    #[serde(default)]
    paths: Vec<String>,
    /// Its lights by number, from 1, scored one at a time; the first when empty.
    #[serde(default)]
    lights: Vec<usize>,
    /// What is too small to matter here, by score.
    #[serde(default)]
    gate: BTreeMap<String, MarginCard>,
}

/// A scene with the names of the paths that are evaluated.
pub(crate) struct Job {
    pub(crate) scene: Scene,
    pub(crate) paths: Vec<String>,
    /// What is too small to matter here, by score.
    gate: BTreeMap<String, MarginCard>,
    /// Made for a bare model: the user edits it for the next run.
    pub(crate) made_file: Option<SceneFile>,
}

/// Everything that is decided before the work begins.
pub(crate) struct Plan {
    pub(crate) name: String,
    pub(crate) jobs: Vec<Job>,
    pub(crate) variants: Vec<VariantId>,
    /// Frames of each path.
    pub(crate) frames: u32,
    pub(crate) sampling: Sampling,
    pub(crate) margins: Margins,
}

/// How large and how often: part of every score.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampling {
    pub(crate) size: (u32, u32),
    /// Frames of a window.
    pub(crate) window: u32,
    pub(crate) seeds: u32,
    /// Of fresh patterns.
    pub(crate) first_seed: u32,
    /// Truth samples in each half.
    pub(crate) samples: u32,
    pub(crate) basis_samples: u32,
    /// Standard error of truth that is wanted at each point.
    pub(crate) tolerance: Option<f32>,
    /// A fault to put in on purpose.
    pub(crate) plant: Option<Plant>,
}

/// Frames of a window, unless the path is shorter (METRICS: T is part of the score).
pub(crate) const WINDOW: u32 = 16;

/// Truth samples of the third estimate: what regions and the projection can tell apart.
pub(crate) const BASIS_SAMPLES: u32 = 1024;

impl Plan {
    /// Resolves the arguments.
    pub(crate) fn new(args: &EvaluateArgs) -> Result<Self, CliError> {
        let file = suite_of(args)?;
        let jobs = jobs_of(args, &file)?;
        let margins = margins_of(&file, &jobs)?;
        let quick = args.quick;
        let frames = args.frames.unwrap_or(if quick { 8 } else { WINDOW });
        let own = file.size.map(|[w, h]| check_size((w, h))).transpose();
        let own = own.map_err(|e| CliError::Usage(format!("the size of suite \"{}\": {e}", file.name)))?;
        let size = args.view.size.or(own.filter(|_| !quick));
        let own = own::techniques(&args.own)?;
        let mut variants = able(chosen_variants(args, &file, &own)?, &jobs, wants_all(&args.variants))?;
        // The user's own are named, whatever else is wanted: they are beside it.
        variants.extend(able(own, &jobs, false)?);
        let variants =
            if frames == 1 { without_history(variants, wants_all(&args.variants))? } else { variants };
        Ok(Self {
            name: if quick { format!("{}-quick", file.name) } else { file.name },
            jobs,
            variants,
            frames,
            sampling: Sampling {
                size: size.unwrap_or(if quick { (192, 108) } else { (320, 180) }),
                window: frames.min(WINDOW),
                seeds: args.seeds.unwrap_or(4),
                first_seed: args.first_seed,
                samples: args.samples.unwrap_or(if quick { 128 } else { 512 }),
                basis_samples: BASIS_SAMPLES,
                tolerance: args.tolerance,
                plant: args.plant,
            },
            margins,
        })
    }
}

/// Those of `--variant`, of the suite, or of the standard suite.
fn chosen_variants(
    args: &EvaluateArgs,
    file: &SuiteFile,
    own: &[VariantId],
) -> Result<Vec<VariantId>, CliError> {
    match (args.variants.as_slice(), file.variants.as_slice()) {
        ([], []) => variants_of(&parse(STANDARD, Path::new("scenes/standard.toml"))?.variants),
        ([], listed) => variants_of(listed),
        (wanted, _) => variants_of(&own::others(wanted, own)),
    }
}

fn wants_all(names: &[String]) -> bool {
    names.iter().any(|name| name == "all")
}

/// Variants that can do the light of every scene. `all` means those; one that was named and cannot is
/// refused.
fn able(variants: Vec<VariantId>, jobs: &[Job], all: bool) -> Result<Vec<VariantId>, CliError> {
    let check = |id: &VariantId| jobs.iter().try_for_each(|job| id.check_light(&job.scene.lights[0]));
    if all {
        return Ok(variants.into_iter().filter(|id| check(id).is_ok()).collect());
    }
    variants.iter().try_for_each(check)?;
    Ok(variants)
}

/// Variants that one frame can score: it says nothing about what comes from the frames before it, and
/// would pass for a still camera. `all` means those; one that was named is refused.
fn without_history(variants: Vec<VariantId>, all: bool) -> Result<Vec<VariantId>, CliError> {
    let looks_back = |id: &VariantId| id.variant.technique.history() > 0;
    match variants.iter().find(|id| looks_back(id)) {
        Some(first) if !all => Err(CliError::Usage(format!(
            "{} has a history: it needs the frames before it, and one frame gives it no temporal score\n  \
             help: give --frames 2 or more, or choose others with --variant",
            first.variant.name
        ))),
        _ => Ok(variants.into_iter().filter(|id| !looks_back(id)).collect()),
    }
}

fn suite_of(args: &EvaluateArgs) -> Result<SuiteFile, CliError> {
    if let [only] = args.what.as_slice()
        && only.extension().is_some_and(|e| e == "toml")
        && !is_scene_file(only)
    {
        let text = std::fs::read_to_string(only).map_err(CliError::file(only))?;
        let mut suite = parse(&text, only)?;
        // Scenes of a suite file lie beside it.
        let folder = only.parent().unwrap_or(Path::new("")).to_owned();
        for scene in &mut suite.scene {
            let beside = folder.join(&scene.name);
            if beside.exists() {
                scene.name = beside;
            }
        }
        return Ok(suite);
    }
    let standard = parse(STANDARD, Path::new("scenes/standard.toml"))?;
    if args.what.is_empty() {
        return Ok(standard);
    }
    // A standard scene brings the standard paths, anything else all of its own.
    let scene = |what: &PathBuf| {
        let known = standard.scene.iter().find(|s| s.name == *what);
        known.cloned().unwrap_or_else(|| SuiteScene { name: what.clone(), ..SuiteScene::default() })
    };
    let stem =
        |p: &PathBuf| p.file_stem().map_or_else(|| "scene".into(), |s| s.to_string_lossy().into_owned());
    let name = args.what.iter().map(stem).collect::<Vec<_>>().join("+");
    Ok(SuiteFile {
        name,
        size: standard.size,
        variants: vec![],
        gate: standard.gate.clone(),
        scene: args.what.iter().map(scene).collect(),
    })
}

/// The suite's margins; scenes by the name that they have in results.
fn margins_of(file: &SuiteFile, jobs: &[Job]) -> Result<Margins, CliError> {
    let mut margins = Margins { all: file.gate.clone(), ..Margins::default() };
    for job in jobs.iter().filter(|job| !job.gate.is_empty()) {
        margins.scenes.insert(job.scene.name.clone(), job.gate.clone());
    }
    match margins.problem() {
        Some(problem) => Err(CliError::Usage(format!("[gate] of the suite \"{}\": {problem}", file.name))),
        None => Ok(margins),
    }
}

/// A suite names scenes; a scene file has geometry.
fn is_scene_file(path: &Path) -> bool {
    std::fs::read_to_string(path)
        .is_ok_and(|text| text.lines().any(|line| line.trim_start().starts_with("[geometry]")))
}

fn parse(text: &str, path: &Path) -> Result<SuiteFile, CliError> {
    toml::from_str(text).map_err(|e| CliError::Suite { path: path.into(), message: e.to_string() })
}

fn jobs_of(args: &EvaluateArgs, file: &SuiteFile) -> Result<Vec<Job>, CliError> {
    for wanted in &args.scenes {
        let names = || file.scene.iter().map(|s| s.name.to_str().unwrap_or_default());
        if !names().any(|n| n == wanted || n == family_of(wanted))
            && !file.scene.iter().any(|s| s.name.exists())
        {
            return Err(no_such_scene(file, wanted));
        }
    }
    let mut jobs: Vec<Job> = Vec::new();
    let quick_scene =
        |s: &&SuiteScene| !args.quick || !args.what.is_empty() || s.name == Path::new("colonnade");
    for entry in file.scene.iter().filter(quick_scene) {
        let chosen = if args.view.lights.is_empty() { &entry.lights } else { &args.view.lights };
        let lights: Vec<Option<usize>> = match chosen.as_slice() {
            [] => vec![None],
            chosen => chosen.iter().copied().map(Some).collect(),
        };
        for light in lights {
            let (scene, made_file) = find_lit_scene(&entry.name, light)?;
            let family = family_of(&scene.name);
            let is_wanted = |wanted: &String| *wanted == scene.name || *wanted == family;
            if !args.scenes.is_empty() && !args.scenes.iter().any(is_wanted) {
                continue;
            }
            let paths =
                paths_of(&scene, if args.view.paths.is_empty() { &entry.paths } else { &args.view.paths })?;
            if jobs.iter().any(|j| j.scene.content_hash() == scene.content_hash() && j.paths == paths) {
                continue;
            }
            jobs.push(Job { scene, paths, gate: entry.gate.clone(), made_file });
        }
    }
    match (jobs.is_empty(), args.scenes.first()) {
        (false, _) => Ok(jobs),
        (true, Some(wanted)) => Err(no_such_scene(file, wanted)),
        (true, None) => Err(CliError::Usage(format!("the suite \"{}\" names no scene", file.name))),
    }
}

/// The wanted paths of a scene, or all of them.
fn paths_of(scene: &Scene, wanted: &[String]) -> Result<Vec<String>, CliError> {
    let all = || scene.paths.iter().map(|p| p.name.clone()).collect();
    let mut paths: Vec<String> = Vec::new();
    for path in if wanted.is_empty() { all() } else { wanted.to_vec() } {
        scene.path(&path)?;
        // Twice the same window would count as two independent ones.
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    Ok(paths)
}

fn no_such_scene(file: &SuiteFile, wanted: &str) -> CliError {
    let names: Vec<&str> = file.scene.iter().filter_map(|s| s.name.to_str()).collect();
    let hint =
        suggest(wanted, names.iter().copied()).map(|s| format!("did you mean \"{s}\"? ")).unwrap_or_default();
    CliError::Usage(format!(
        "the suite \"{}\" has no scene \"{wanted}\"; {hint}it has {}",
        file.name,
        names.join(", ")
    ))
}

/// The variants of the names given, in display order.
pub(crate) fn variants_of(names: &[String]) -> Result<Vec<VariantId>, CliError> {
    let every: Vec<VariantId> = VARIANTS.iter().flat_map(|v| select_variants(v.name)).collect();
    let mut wanted: Vec<String> = Vec::new();
    for name in names {
        let found = select_variants(name);
        if found.is_empty() {
            let known: Vec<String> = every.iter().map(VariantId::name).collect();
            let candidates = known.iter().map(String::as_str).chain(VARIANTS.iter().map(|v| v.name));
            let hint =
                suggest(name, candidates).map(|s| format!("; did you mean \"{s}\"?")).unwrap_or_default();
            let message =
                format!("unknown variant \"{name}\"{hint}\n  help: `umbrage list variants` shows all");
            return Err(CliError::Usage(message));
        }
        wanted.extend(found.iter().map(VariantId::name));
    }
    Ok(every.into_iter().filter(|id| wanted.contains(&id.name())).collect())
}
