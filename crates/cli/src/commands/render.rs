//! `umbrage render`: a variant's frames to EXR, with every intermediate target on request.

use super::open_gpu;
use crate::args::RenderArgs;
use crate::error::CliError;
use crate::output::print;
use crate::own;
use crate::scenes::{find_lit_scene, only_light};
use crate::suite::variants_of;
use crate::views::{frame_of, past_of, path_of, view_of};
use std::time::Duration;
use umbrage_frame::{Image, Layer, write_exr};
use umbrage_shadows::{Calibration, Dump, LightMap, ReceiverPlane, Renderer, Seeding};

pub(crate) fn run(args: &RenderArgs) -> Result<(), CliError> {
    let (scene, _) = find_lit_scene(&args.scene, only_light(&args.view.lights)?)?;
    let own = own::techniques(&args.own)?;
    let mut variants = variants_of(&own::others(&args.variants, &own))?;
    variants.extend(own);
    let path = path_of(&scene, &args.view.paths)?;
    let size = args.view.size.unwrap_or((1280, 720));
    let mut gpu = open_gpu(&args.view.gpu)?;
    gpu.set_patience(Duration::from_secs(args.own.patience));
    let mut renderer = Renderer::new(&mut gpu, &scene, args.view.map)?;
    std::fs::create_dir_all(&args.out).map_err(CliError::file(&args.out))?;
    for number in args.frame..args.frame.saturating_add(args.frames) {
        let frame = frame_of(path, number)?;
        let view = view_of(frame, size);
        renderer.set_past(past_of(path, number, size));
        for &variant in &variants {
            let pattern = (Seeding::Frozen, [number, 0]);
            let stem = format!("{}.{number:04}", variant.name().replace('/', "-"));
            let (shaded, dumps) = if args.dump {
                renderer.dump(variant, (&view, &frame.light), pattern)?
            } else {
                (renderer.shade_frame(variant, (&view, &frame.light), pattern)?, vec![])
            };
            let mask = Image::from_pixels(size.0, size.1, shaded.values);
            let file = args.out.join(format!("{stem}.exr"));
            write_exr(&file, &[("visibility.V".to_string(), mask)])?;
            print(&file.display().to_string())?;
            for dump in &dumps {
                // Levels below the finest have names of their own.
                let level = if dump.level > 0 { format!(".level{}", dump.level) } else { String::new() };
                let file = args.out.join(format!("{stem}.{}{level}.exr", dump.label));
                write_exr(&file, &layers(dump))?;
                print(&file.display().to_string())?;
            }
        }
        if args.dump {
            let map = renderer.light_map(&frame.light);
            let file = args.out.join(format!("matrices.{number:04}.json"));
            let matrices = serde_json::json!({
                "convention": "column vectors, columns listed one after the other; depth in maps is linear, in metres",
                "clip_from_world": view.clip_from_world.to_cols_array(),
                "camera_from_world": view.camera_from_world.to_cols_array(),
                "yfov_radians": view.yfov_radians,
                "light_from_world": map.light_from_world.to_cols_array(),
                "light_clip_from_world": map.clip_from_world.to_cols_array(),
                "light_kind": format!("{:?}", map.kind),
                "map_widths_per_metre_or_slope": map.scale,
                "light_size": map.light_size,
                "nearest_blocker_metres": map.nearest_blocker,
                "far_metres": map.far,
                "reference_gap_metres": map.reference_gap,
                "bias": Calibration::ALL.map(|calibration| (calibration.name().to_string(), bias(calibration, &map)))
                    .into_iter().collect::<serde_json::Map<_, _>>(),
            });
            std::fs::write(&file, format!("{matrices:#}\n")).map_err(CliError::file(&file))?;
            print(&file.display().to_string())?;
        }
    }
    Ok(())
}

/// The three kinds of bias, for whoever recomputes a pixel.
fn bias(calibration: Calibration, map: &LightMap) -> serde_json::Value {
    let bias = calibration.default_bias();
    serde_json::json!({
        "constant_metres": bias.constant_world(map),
        "normal_offset_texels": bias.normal_offset_texels,
        "receiver_plane_max_slope": match bias.receiver_plane {
            ReceiverPlane::Off => 0.0,
            ReceiverPlane::On { max_slope } => max_slope,
        },
    })
}

/// Channels as viewers expect them: a map is a `Z` or `V`, a normal is `X Y Z`.
fn layers(dump: &Dump) -> Vec<Layer> {
    let names: &[&str] = match (dump.label, dump.channels.len()) {
        ("camera-depth" | "earlier-1-depth" | "earlier-2-depth" | "earlier-3-depth", _) => &["depth.Z"],
        (label, _) if label.ends_with("-normal") => &["normal.X", "normal.Y", "normal.Z"],
        (label, _) if label.contains("penumbra") => &["penumbra.V"],
        (label, _) if label.contains("lit-") => &["visibility.V", "radius.V"],
        _ => &["light-depth.Z"],
    };
    names.iter().zip(&dump.channels).map(|(name, image)| ((*name).to_string(), image.clone())).collect()
}
