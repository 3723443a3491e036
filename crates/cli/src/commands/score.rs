//! `umbrage score`: frames of another engine.

use super::evaluate::{command_line, layout, run_folder};
use super::{check_masks, gate, open_truth_gpu};
use crate::args::ScoreArgs;
use crate::clock;
use crate::error::CliError;
use crate::output::print;
use crate::run::elsewhere::{Frames, ScorePlan, ScoreSettings, nobody, score, score_without_cameras};
use crate::scenes::find_scene;
use std::path::Path;
use umbrage_frame::NumberedFiles;
use umbrage_report::write_report;
use umbrage_scene::{CameraFile, CameraPath, FrameCamera, LightSpec, PathFrame, Scene};

pub(crate) fn run(args: &ScoreArgs) -> Result<(), CliError> {
    args.save_baseline.as_deref().map_or(Ok(()), gate::check_name)?;
    if let Some(name) = &args.baseline {
        // That it is not there is said before the work, not after it.
        gate::place_of(name, &nobody(), &args.gate.baselines)?;
    }
    let frames = Frames::find(args)?;
    let now = clock::now();
    let named = |name: &str| args.out.clone().unwrap_or_else(|| run_folder(name, &now.folder));
    let (card, notes, out) = match (&args.reference_frames, &args.scene) {
        (Some(pattern), _) => {
            let reference = NumberedFiles::find(pattern)?;
            let out = named("frames");
            let settings = ScoreSettings { truth_gpu: None, out: out.clone(), command: command_line(), now };
            let (card, notes) = score_without_cameras(&frames, &reference, &settings)?;
            (card, notes, out)
        }
        (None, Some(scene)) => {
            let plan = plan(args, scene, frames)?;
            check_masks(args.truth.reference_on, [&plan.scene])?;
            let out = named(&plan.name);
            let truth_gpu = open_truth_gpu(args.truth.reference_on, &args.gpu)?;
            let settings = ScoreSettings { truth_gpu, out: out.clone(), command: command_line(), now };
            let (card, notes) = score(&plan, args, &settings)?;
            (card, notes, out)
        }
        (None, None) => {
            return Err(CliError::Usage("give --scene with --cameras, or --reference-frames".into()));
        }
    };
    if args.light.is_none() && args.scene.is_some() {
        eprintln!("note: no --light: the scene's own first light is taken for the frames'");
    }
    let mut said: Vec<&String> = Vec::new();
    for note in notes.iter().chain(card.windows.iter().flat_map(|w| &w.notes)) {
        if !said.contains(&note) {
            said.push(note);
            eprintln!("note: {note}");
        }
    }
    let written = write_report(&out, layout(args.report))?;
    for warning in &written.warnings {
        eprintln!("warning: {warning}");
    }
    if args.json {
        print(card.to_json()?.trim_end())?;
    }
    eprintln!("report: {}", written.index.display());
    let names = (args.baseline.as_ref(), args.save_baseline.as_ref());
    gate::after_run(&out, names, &args.gate, (args.report, args.json))
}

/// Scene, light, cameras and frames, put together and checked against each other.
fn plan(args: &ScoreArgs, scene: &Path, frames: Frames) -> Result<ScorePlan, CliError> {
    let (scene, _) = find_scene(scene)?;
    let light = match &args.light {
        Some(file) => LightSpec::read(file, scene.origin)?,
        None => scene.lights[0],
    };
    let (mut path, numbers, file) = match &args.cameras {
        Some(file) => {
            let file = CameraFile::read(file, args.convention)?;
            let convention = file.convention;
            let cameras = file.cameras(&convention, scene.origin)?;
            check_sizes(&file, &cameras, frames.size)?;
            let numbers = cameras.iter().map(|c| c.index).collect();
            (path_from(&file, &cameras, light), numbers, Some(file))
        }
        None => own_path(args, &scene, &frames)?,
    };
    if args.light.is_some() {
        path.frames.iter_mut().for_each(|f| f.light = light);
    }
    frames.check_numbers(&numbers)?;
    let name = format!("{}-{}", scene.name, path.name);
    Ok(ScorePlan { scene, path, numbers, file, frames, name })
}

/// A path of the scene. As many files as it has frames are its frames, whatever the first one's number; fewer
/// are those of their numbers.
fn own_path(
    args: &ScoreArgs,
    scene: &Scene,
    frames: &Frames,
) -> Result<(CameraPath, Vec<u32>, Option<CameraFile>), CliError> {
    let path = match (&args.path, scene.paths.as_slice()) {
        (Some(name), _) => scene.path(name)?,
        (None, [only]) => only,
        (None, many) => {
            let names: Vec<&str> = many.iter().map(|p| p.name.as_str()).collect();
            return Err(CliError::Usage(format!(
                "whose cameras? give --cameras FILE, or --path with one of {}",
                names.join(", ")
            )));
        }
    };
    let numbers = frames.numbers();
    if numbers.len() == path.frames.len() {
        return Ok((path.clone(), numbers, None));
    }
    let beyond = numbers.iter().find(|&&n| n as usize >= path.frames.len());
    if let Some(number) = beyond {
        return Err(CliError::Projection(format!(
            "{} has {} frames, but there is a frame {number}\n  help: give as many frames as the path has, or number them \
             from 0 as it does",
            path.name,
            path.frames.len()
        )));
    }
    let kept = numbers.iter().map(|&n| path.frames[n as usize]).collect();
    Ok((CameraPath { frames: kept, ..path.clone() }, numbers, None))
}

fn path_from(file: &CameraFile, cameras: &[FrameCamera], light: umbrage_scene::AreaLight) -> CameraPath {
    let stem = file.path.file_stem().map_or_else(|| "cameras".into(), |s| s.to_string_lossy().into_owned());
    let frame = |c: &FrameCamera| PathFrame { camera: c.camera, light, time_secs: c.time_secs };
    CameraPath {
        name: stem,
        title: format!("{} cameras of another program", cameras.len()),
        frames_per_second: file.frames_per_second as f32,
        frames: cameras.iter().map(frame).collect(),
    }
}

/// A picture that was cropped or scaled has other cameras.
fn check_sizes(
    file: &CameraFile,
    cameras: &[FrameCamera],
    (width, height): (u32, u32),
) -> Result<(), CliError> {
    let odd = cameras
        .iter()
        .find(|c| c.size.is_some_and(|size| size != (width, height)) || (c.square && width != height));
    let Some(odd) = odd else { return Ok(()) };
    let wanted = odd.size.map_or_else(|| "a square picture".to_string(), |(w, h)| format!("{w}x{h}"));
    Err(CliError::Projection(format!(
        "{}: frame {} is of {wanted}, but the frames have {width}x{height}\n  help: write frames in the size that the cameras \
         were written for",
        file.path.display(),
        odd.index
    )))
}
