//! Frames whose cameras nobody knows: each against a true frame, in the picture's own plane. Nothing is followed
//! from frame to frame, so nothing is said about swimming.

use super::Frames;
use crate::error::CliError;
use crate::run::window::{Facts, Window};
use glam::{Mat4, Vec3, Vec4};
use umbrage_frame::{Anchors, Image, NumberedFiles, View};
use umbrage_metrics::{Coverage, PanelTruth, Region, TILE_PX, Tiling};
use umbrage_scene::AreaLight;

/// What a reader must know.
pub(super) const NOTE: &str = "frames without cameras: per-frame scores only; no swimming, and widths are in pixels of the \
                               picture. The true frames are taken for exact";

/// One frame: its pixels are points of a plane, a metre a pixel.
pub(super) fn window(frames: &Frames, reference: &NumberedFiles, number: u32) -> Result<Window, CliError> {
    let truth = frames.mask(reference, number)?.image;
    let (width, height) = frames.size;
    let view = View {
        width,
        height,
        clip_from_world: Mat4::from_cols(
            Vec4::new(2.0 / width as f32, 0.0, 0.0, 0.0),
            Vec4::new(0.0, 2.0 / height as f32, 0.0, 0.0),
            Vec4::Z,
            Vec4::new(-1.0, 1.0, 0.5, 1.0),
        ),
        camera_from_world: Mat4::IDENTITY,
        yfov_radians: 1.0,
    };
    let pixel: Vec<u32> = (0..width * height).filter(|&p| truth.pixels()[p as usize].is_finite()).collect();
    let place = |&p: &u32| Vec3::new((p % width) as f32 + 0.5, -((p / width) as f32 + 0.5), 0.0);
    let anchors = Anchors {
        view,
        position: pixel.iter().map(place).collect(),
        normal: vec![Vec3::Z; pixel.len()],
        pixel,
    };
    let values: Vec<f32> =
        anchors.pixel.iter().map(|&p| truth.pixels()[p as usize].clamp(0.0, 1.0)).collect();
    let points = values.len();
    let truth = PanelTruth {
        frames: 1,
        halves: [values.clone(), values.clone()],
        basis: values,
        variance: vec![0.0; points],
    };
    let tiling = Tiling::new(&anchors, &truth, &vec![true; points], TILE_PX)?;
    let light = AreaLight::Sun { direction_to_light: Vec3::Z, angular_diameter_radians: 0.0 };
    let all = Coverage {
        pixels: (width * height) as usize,
        anchors: points,
        facing: points,
        counted: points,
        inside: points,
        hidden: 0,
        seen: points,
        disagreeing: 0,
    };
    Ok(Window {
        scene: "frames".into(),
        path: "without cameras".into(),
        first: number,
        step: 1,
        frames: vec![(view, light)],
        pasts: vec![Vec::new()],
        anchors,
        truth,
        pixel_truth: None,
        tiling,
        truth_key: String::new(),
        shading: Image::filled(width, height, Vec3::splat(0.8)),
        coverage: all,
        truth_secs: None,
        notes: Vec::new(),
    })
}

pub(super) fn facts(window: &Window, (width, height): (u32, u32)) -> Facts {
    Facts {
        scene: window.scene.clone(),
        path: window.path.clone(),
        first: window.first,
        frames: 1,
        step: 1,
        title: format!("frame {}", window.first),
        coverage: window.coverage,
        tiles: window.tiling.tiles.iter().filter(|t| !t.penumbra.is_empty()).count(),
        views: format!("{width}x{height}"),
        truth_secs: None,
        notes: window
            .tiling
            .regions
            .iter()
            .all(|r| *r != Region::Penumbra)
            .then(|| "this frame has no penumbra".to_string())
            .into_iter()
            .chain(window.notes.clone())
            .collect(),
    }
}
