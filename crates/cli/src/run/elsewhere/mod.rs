//! Frames of another program: truth for their cameras, the pixel reading of METRICS section 2, and the same
//! report as of our own variants.

mod asked;
mod frames;
mod guesses;
mod lights;
mod panel;
mod projection;
mod windows;
mod without_cameras;
mod words;

pub(crate) use frames::{Frames, subject_name};
pub(crate) use words::nobody;

use super::measure::Measured;
use super::{Scored, pictures, scorecard, sums, window};
use crate::args::ScoreArgs;
use crate::clock::Now;
use crate::error::CliError;
use crate::interrupt;
use crate::progress::Progress;
use crate::suite::{BASIS_SAMPLES, Sampling, WINDOW};
use asked::Shown;
use frames::listed;
use guesses::guesses;
use std::path::PathBuf;
use umbrage_metrics::Bootstrap;
use umbrage_reference::{Cache, Finder, Tracer, TruthGpu};
use umbrage_report::{Margins, RunWriter, SUMS, Scorecard, WindowPictures};
use umbrage_scene::{AreaLight, Camera, CameraFile, CameraPath, Scene};
use window::{Readings, Request, Window};

/// Everything that is decided before the work begins.
pub(crate) struct ScorePlan {
    pub(crate) scene: Scene,
    /// With the light that is scored, in each frame.
    pub(crate) path: CameraPath,
    /// The number of each frame of the path.
    pub(crate) numbers: Vec<u32>,
    /// Where the cameras were read, unless they are the scene's own.
    pub(crate) file: Option<CameraFile>,
    pub(crate) frames: Frames,
    pub(crate) name: String,
}

/// Where things go.
pub(crate) struct ScoreSettings {
    pub(crate) truth_gpu: Option<TruthGpu>,
    pub(crate) out: PathBuf,
    pub(crate) command: String,
    pub(crate) now: Now,
}

/// Scores and stores the run; pages are made from it afterwards.
pub(crate) fn score(
    plan: &ScorePlan,
    args: &ScoreArgs,
    settings: &ScoreSettings,
) -> Result<(Scorecard, Vec<String>), CliError> {
    let tracer = Tracer::new(&plan.scene)?;
    let mut notes: Vec<String> = plan.frames.spare(&plan.numbers, "camera");
    notes.extend(match args.no_projection_check {
        true => vec!["whether the cameras fit the frames was not checked: --no-projection-check".into()],
        false => check_projection(plan, &tracer, args.light.is_some())?,
    });
    let windows = windows::windows(&plan.numbers, WINDOW as usize);
    notes.extend(windows.notes);
    if plan.frames.unshadowed.is_some() && plan.frames.bits.is_some() {
        notes.push("the error of the format's steps in a ratio depends on how bright the pictures are, and is not known; banding of \
                    dark surfaces may be the format's: write floats".into());
    }
    let mut finder = Finder::new(&tracer, settings.truth_gpu.as_ref())?;
    let cache = Cache::open(args.cache.join("truth"))?;
    let mut writer = RunWriter::create(&settings.out)?;
    let sampling = sampling(plan, args, windows.length);
    let mut progress = Progress::new((windows.places.len() * (1 + plan.frames.subjects.len())) as u64);
    let mut scored = Vec::new();
    for (index, places) in windows.places.into_iter().enumerate() {
        let numbers = &plan.numbers[places.clone()];
        let last = numbers[numbers.len() - 1];
        progress.say(format!("{}, frames {} to {last}: truth", plan.path.name, numbers[0]));
        let request = Request {
            scene: &plan.scene,
            path: &plan.path,
            first: numbers[0],
            step: windows.step,
            frames: &plan.path.frames[places],
            readings: Readings::Elsewhere,
        };
        let mut window = Window::new(&request, (&mut finder, &cache, None), &sampling)?;
        panel::leave_out_the_undefined(&mut window, (&plan.frames, numbers))?;
        progress.advance(1);
        writer.window_pictures(index, &pictures::window(&window))?;
        let mut variants = Vec::new();
        for (place, subject) in plan.frames.subjects.iter().enumerate() {
            interrupt::check(&args.cache)?;
            progress.say(format!("{}, frames from {}: {}", plan.path.name, numbers[0], subject.name));
            let measured: Measured = panel::measure(&mut window, (&plan.frames, numbers), subject)?;
            writer.variant_pictures(index, place, &measured.pictures)?;
            variants.push(measured.without_pictures());
            progress.advance(1);
        }
        scored.push(Scored { window: window.facts(&plan.path), variants });
    }
    progress.finish();
    let provenance = words::provenance(plan, (args, &sampling, settings), notes.clone());
    finish(writer, (provenance, words::subjects(&plan.frames)), &scored, settings).map(|card| (card, notes))
}

/// The scorecard and the sums of a run of frames from elsewhere.
fn finish(
    writer: RunWriter,
    (provenance, subjects): (umbrage_report::Provenance, scorecard::Subjects),
    scored: &[Scored],
    settings: &ScoreSettings,
) -> Result<Scorecard, CliError> {
    let names: Vec<String> =
        subjects.cards.iter().map(|c| format!("{}/{}", c.name, c.calibration.id())).collect();
    let single: Vec<bool> = subjects.cards.iter().map(|c| c.taps == words::ONE_TAKE).collect();
    let mut card = scorecard::assemble(provenance, subjects, scored, &Bootstrap::default())?;
    words::relabel(&mut card, &single);
    sums::of((names, Margins::default()), &card.provenance, scored).save(&settings.out.join(SUMS))?;
    writer.finish(&card)?;
    if scored.iter().all(|s| s.window.coverage.counted == 0) {
        return Err(CliError::NothingScored("no surface point of the frames counts".into()));
    }
    Ok(card)
}

/// Frames without cameras against true frames, one by one.
pub(crate) fn score_without_cameras(
    frames: &Frames,
    reference: &umbrage_frame::NumberedFiles,
    settings: &ScoreSettings,
) -> Result<(Scorecard, Vec<String>), CliError> {
    let mut writer = RunWriter::create(&settings.out)?;
    let numbers: Vec<u32> = reference.files.keys().copied().collect();
    frames.check_numbers(&numbers)?;
    let mut scored = Vec::new();
    for (index, &number) in numbers.iter().enumerate() {
        let mut window = without_cameras::window(frames, reference, number)?;
        // Pixels of a plane: there is nothing to see of a scene, and no depth.
        let planes = WindowPictures { beauty: None, surface: None, ..pictures::window(&window) };
        writer.window_pictures(index, &planes)?;
        let mut variants = Vec::new();
        for (place, subject) in frames.subjects.iter().enumerate() {
            let measured = panel::measure(&mut window, (frames, &[number]), subject)?;
            writer.variant_pictures(index, place, &measured.pictures)?;
            variants.push(measured.without_pictures());
        }
        scored.push(Scored { window: without_cameras::facts(&window, frames.size), variants });
    }
    let mut notes = vec![without_cameras::NOTE.to_string()];
    notes.extend(frames.spare(&numbers, "true frame"));
    let holes = reference.holes();
    if !holes.is_empty() {
        notes.push(format!("{}: frames {} are missing and not scored", reference.pattern, listed(&holes)));
    }
    notes.extend(frames.repeated(reference)?);
    let provenance = words::provenance_without_cameras(frames, settings, notes.clone());
    finish(writer, (provenance, words::subjects(frames)), &scored, settings).map(|card| (card, notes))
}

fn sampling(plan: &ScorePlan, args: &ScoreArgs, window: usize) -> Sampling {
    let takes = plan.frames.subjects.iter().map(|s| s.takes.len()).max().unwrap_or(1);
    Sampling {
        size: plan.frames.size,
        window: window as u32,
        seeds: takes as u32,
        first_seed: 0,
        samples: args.samples,
        basis_samples: BASIS_SAMPLES,
        tolerance: args.tolerance,
        plant: None,
    }
}

/// Frames of every take that are looked at: a frame too many or too few shows in those after it.
const CHECKED: usize = 5;

/// Every take's cameras, in a few frames from the first to the last.
fn check_projection(
    plan: &ScorePlan,
    tracer: &Tracer,
    light_is_given: bool,
) -> Result<Vec<String>, CliError> {
    let count = plan.numbers.len();
    let mut places: Vec<usize> = (0..CHECKED).map(|i| i * (count - 1) / (CHECKED - 1)).collect();
    places.dedup();
    let cameras: Vec<Camera> = plan.path.frames.iter().map(|f| f.camera).collect();
    let (width, height) = plan.frames.size;
    let file = plan.file.as_ref().map(|file| (file, plan.scene.origin));
    let all = guesses(&cameras, width as f32 / height as f32, file);
    let lights: Vec<AreaLight> = places.iter().map(|&place| plan.path.frames[place].light).collect();
    let takes: Vec<_> = plan.frames.subjects.iter().flat_map(|s| &s.takes).collect();
    let mut said: Vec<String> = Vec::new();
    for take in &takes {
        let mut shown = Vec::new();
        for &place in &places {
            shown.push(Shown { place, mask: plan.frames.mask(take, plan.numbers[place])? });
        }
        let checked = projection::check(
            tracer,
            (&lights, plan.frames.size),
            (&shown, light_is_given),
            (&cameras, &all),
        );
        let words = checked.map_err(|refused| match refused {
            CliError::Projection(message) => CliError::Projection(format!("{}: {message}", take.pattern)),
            other => other,
        })?;
        said.push(if takes.len() > 1 { format!("{}: {words}", take.pattern) } else { words });
    }
    Ok(said)
}
