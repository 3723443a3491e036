//! `umbrage reference`: ground truth of one frame to EXR.

use super::{check_masks, open_truth_gpu};
use crate::args::{MethodArg, ReferenceArgs, ReferenceOn};
use crate::error::CliError;
use crate::output::print;
use crate::run::truths::reached_note;
use crate::scenes::{find_lit_scene, only_light};
use crate::views::{frame_of, path_of, view_of};
use std::path::{Path, PathBuf};
use umbrage_frame::{Image, Layer, write_exr};
use umbrage_reference::{
    Finder, MOST_ON_SCANLINES, Method, PrimaryHits, RadianceSettings, Tracer, TruthSettings,
};
use umbrage_scene::PathFrame;

pub(crate) fn run(args: &ReferenceArgs) -> Result<(), CliError> {
    check_samples(args)?;
    let on = wanted_place(args)?;
    let (scene, _) = find_lit_scene(&args.scene, only_light(&args.view.lights)?)?;
    check_masks(on, [&scene])?;
    let path = path_of(&scene, &args.view.paths)?;
    let numbers = args.frame..args.frame.saturating_add(args.frames);
    // Names that are wrong are wrong before the first hour of work.
    let frames = numbers.map(|n| Ok((n, frame_of(path, n)?))).collect::<Result<Vec<_>, CliError>>()?;
    if let Some(folder) = args.out.parent().filter(|f| !f.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(CliError::file(&args.out))?;
    }
    let tracer = Tracer::new(&scene)?;
    let gpu = open_truth_gpu(on, &args.view.gpu)?;
    let mut finder = Finder::new(&tracer, gpu.as_ref())?;
    for (number, frame) in frames {
        let layers = layers(args, &mut finder, frame)?;
        let file = numbered(&args.out, (args.frames > 1).then_some(number));
        write_exr(&file, &layers)?;
        print(&file.display().to_string())?;
    }
    Ok(())
}

/// Everything that is known of a frame.
fn layers(args: &ReferenceArgs, finder: &mut Finder<'_>, frame: &PathFrame) -> Result<Vec<Layer>, CliError> {
    let view = view_of(frame, args.view.size.unwrap_or((1280, 720)));
    let tracer = finder.tracer();
    let hits = tracer.primary(&view);
    let settings = TruthSettings {
        samples: args.samples,
        method: match args.method {
            MethodArg::Shafts => Method::Shafts,
            MethodArg::Rays => Method::Rays,
            MethodArg::Scanlines => Method::Scanlines,
            MethodArg::ScanlineRays => Method::ScanlineRays,
        },
        tolerance: args.tolerance,
        // No layer of them is written.
        basis_samples: 0,
        ..TruthSettings::default()
    };
    let points = hits.points();
    let truth = finder.truth(&points, &frame.light, &settings)?;
    let mut layers = surfaces(&hits);
    let mut add = |name: &str, values: &[f32]| layers.push((name.to_string(), spread(&hits, values)));
    add("reference.V", &truth.mean);
    add("half1.V", &truth.halves[0]);
    add("half2.V", &truth.halves[1]);
    add("variance.V", &truth.variance);
    if !args.only_v {
        let irradiance = tracer.irradiance(&points, &frame.light, &settings);
        add("irradiance.E", &irradiance.shadowed);
        add("irradiance.E0", &irradiance.unshadowed);
        add("irradiance.R", &irradiance.ratio);
    }
    if let Some(tolerance) = args.tolerance {
        add("samples.V", &truth.samples.iter().map(|&s| s as f32).collect::<Vec<_>>());
        eprintln!("{}", reached_note(&truth.reached(tolerance), tolerance));
    }
    if let Some(bounces) = args.bounces {
        let settings = RadianceSettings { samples: args.beauty_samples, bounces, seed: 0 };
        let beauty = tracer.radiance(&view, &frame.light, &settings);
        layers.extend(
            ["R", "G", "B"].into_iter().enumerate().map(|(k, name)| (name.to_string(), beauty.map(|v| v[k]))),
        );
    }
    Ok(layers)
}

/// "truth.exr" of frame 7 is "truth.0007.exr".
fn numbered(out: &Path, number: Option<u32>) -> PathBuf {
    let Some(number) = number else { return out.to_owned() };
    let end = out.extension().map_or_else(|| "exr".into(), |e| e.to_string_lossy());
    out.with_extension(format!("{number:04}.{end}"))
}

/// Other methods are the CPU's.
fn wanted_place(args: &ReferenceArgs) -> Result<ReferenceOn, CliError> {
    match (args.truth.reference_on, args.method) {
        (on, MethodArg::Scanlines) => Ok(on),
        (ReferenceOn::Gpu, _) => {
            Err(CliError::Usage("--reference-on gpu: a GPU does --method scanlines only".into()))
        }
        _ => Ok(ReferenceOn::Cpu),
    }
}

/// What scanlines cannot hold is refused, not cut.
fn check_samples(args: &ReferenceArgs) -> Result<(), CliError> {
    let lines = matches!(args.method, MethodArg::Scanlines | MethodArg::ScanlineRays);
    if lines && args.samples > MOST_ON_SCANLINES {
        return Err(CliError::Usage(format!(
            "--samples {}: scanlines hold at most {MOST_ON_SCANLINES} in each half; take fewer, or --method shafts",
            args.samples
        )));
    }
    Ok(())
}

/// A value per hit as a picture; 0 where nothing is hit.
fn spread(hits: &PrimaryHits, values: &[f32]) -> Image<f32> {
    let depth = &hits.gbuffer.depth;
    let mut next = values.iter();
    let pixel = |d: &f32| if d.is_finite() { next.next().copied().unwrap_or(0.0) } else { 0.0 };
    depth.map(pixel)
}

fn surfaces(hits: &PrimaryHits) -> Vec<Layer> {
    let gbuffer = &hits.gbuffer;
    let axis = |image: &Image<glam::Vec3>, k: usize| image.map(|v| v[k]);
    let mut layers =
        vec![("depth.Z".to_string(), gbuffer.depth.map(|&d| if d.is_finite() { d } else { 0.0 }))];
    for (k, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        layers.push((format!("normal.{name}"), axis(&gbuffer.normal, k)));
        layers.push((format!("position.{name}"), axis(&gbuffer.position, k)));
    }
    layers
}
