//! What is shown of a window: planes of its middle frame, and each of its points frame by frame.

use super::panel::{Draw, Reading, shade_panel};
use super::window::Window;
use crate::args::Plant;
use crate::error::CliError;
use std::path::Path;
use umbrage_frame::{Image, write_exr};
use umbrage_metrics::{Panel, PointMaps, Region, true_widths};
use umbrage_report::{CELLS, CellMaps, Surface, VariantPictures, WindowPictures};
use umbrage_shadows::{Renderer, Seeding, VariantId};

/// Pictures up to this size are kept frame by frame: above it a run of a few windows would take
/// gigabytes, and no page could show them.
const SERIES_PIXELS: u32 = 640 * 360;

/// What all variants of a window share; NaN where nothing is seen.
pub(super) fn window(window: &Window) -> WindowPictures {
    let spread = |value: &dyn Fn(usize) -> f32| window.spread(value, f32::NAN);
    let (view, truth) = (&window.anchors.view, &window.truth);
    let in_frame =
        |frame| move |point: usize| 0.5 * (truth.half(0, frame, point) + truth.half(1, frame, point));
    // A window whose points do not fit together has no widths, and says so elsewhere.
    let widths = true_widths(truth, &window.anchors, &window.tiling).ok();
    let surface = Surface {
        depth: spread(&|point| view.depth(window.anchors.position[point])),
        region: spread(&|point| match window.tiling.regions[point] {
            Region::LeftOut => Surface::LEFT_OUT,
            Region::Umbra => Surface::UMBRA,
            Region::Penumbra => Surface::PENUMBRA,
            Region::Lit => Surface::LIT,
        }),
        truth_error: spread(&|point| truth.variance[point].max(0.0).sqrt()),
        width: widths.map(|widths| spread(&|point| widths[point])),
        cameras: window.frames.iter().map(|(view, _)| view.clip_from_world.to_cols_array()).collect(),
    };
    let moves = truth.frames > 1 && is_small(window);
    WindowPictures {
        truth: spread(&|point| truth.mean(point) as f32),
        truth_series: (0..truth.frames).filter(|_| moves).map(|t| spread(&in_frame(t))).collect(),
        beauty: Some(window.beauty()),
        surface: Some(surface),
    }
}

/// A variant at every point and frame, its patterns as a game would ship them. What changes here is
/// what a player sees crawl, the noise that sticks to the screen included.
pub(super) fn series(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
    plant: Option<Plant>,
) -> Result<Vec<Image<f32>>, CliError> {
    let frames = window.frames.len();
    if frames < 2 || window.anchors.is_empty() || !is_small(window) {
        return Ok(Vec::new());
    }
    let draw = Draw { seeding: Seeding::Frozen, seeds: 1, first_seed: 0, frames, plant };
    Ok(series_of(window, &shade_panel(window, (variant, renderer), Reading::Anchored, draw)?))
}

/// The first seed of a panel, frame by frame; none of one frame, or of a large picture.
pub(super) fn series_of(window: &Window, panel: &Panel) -> Vec<Image<f32>> {
    let frames = if panel.frames > 1 && is_small(window) { panel.frames } else { 0 };
    (0..frames).map(|t| window.spread(|point| panel.at(t, 0, point), f32::NAN)).collect()
}

fn is_small(window: &Window) -> bool {
    let (width, height) = window.size();
    width * height <= SERIES_PIXELS
}

/// A variant as a game would show it, its error in that very frame, and where it swims.
pub(super) fn variant(window: &Window, mask: Image<f32>, maps: &PointMaps) -> VariantPictures {
    let only_counted = |point: usize, value: f32| if window.is_counted(point) { value } else { f32::NAN };
    let pixel = |point: usize| window.anchors.pixel[point] as usize;
    let error = window.spread(
        |point| only_counted(point, mask.pixels()[pixel(point)] - window.truth.mean(point) as f32),
        f32::NAN,
    );
    // One frame does not move.
    let moves = window.frames.len() > 1;
    let swim = moves.then(|| window.spread(|point| only_counted(point, maps.swim[point]), f32::NAN));
    // Where nothing is seen there is no shadow to show.
    let mask = window.spread(|point| mask.pixels()[pixel(point)], f32::NAN);
    VariantPictures { mask, error, swim, series: Vec::new(), cells: cells(window, maps) }
}

/// Each cell where it lies: by pixel of small pictures, and by tile of all.
fn cells(window: &Window, maps: &PointMaps) -> CellMaps {
    let moves = window.frames.len() > 1;
    let of: [(&[f32], bool); CELLS.len()] = [
        (&maps.smooth_static, true),
        (&maps.structured_static, true),
        (&maps.smooth_moving, moves),
        (&maps.structured_moving, moves),
        (&maps.noise, true),
    ];
    let in_penumbra = |point: usize| window.tiling.regions[point] == Region::Penumbra;
    let value = |(map, measured): (&[f32], bool), point: usize| {
        if measured && in_penumbra(point) { map[point] } else { f32::NAN }
    };
    let (width, height) = window.size();
    let side = window.tiling.tile_px;
    let tiles = |of| {
        let mut image = Image::filled(width.div_ceil(side), height.div_ceil(side), f32::NAN);
        for tile in window.tiling.tiles.iter().filter(|t| !t.penumbra.is_empty()) {
            let sum: f64 = tile.penumbra.iter().map(|&p| f64::from(value(of, p as usize))).sum();
            let at = (tile.row * image.width() + tile.column) as usize;
            image.pixels_mut()[at] = (sum / tile.penumbra.len() as f64) as f32;
        }
        image
    };
    CellMaps {
        pixels: of
            .iter()
            .filter(|_| is_small(window))
            .map(|&of| window.spread(|point| value(of, point), f32::NAN))
            .collect(),
        tiles: of.into_iter().map(tiles).collect(),
    }
}

/// Every frame of the window as EXR, as a game would show it.
pub(super) fn keep_frames(
    out: &Path,
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
) -> Result<(), CliError> {
    let folder = out
        .join("frames")
        .join(format!("{}-{}", window.scene, window.path))
        .join(variant.name().replace('/', "-"));
    std::fs::create_dir_all(&folder).map_err(CliError::file(&folder))?;
    let (width, height) = window.size();
    for (frame, (view, light)) in window.frames.iter().enumerate() {
        let number = window.first + frame as u32;
        renderer.set_past(window.past(frame));
        let shaded = renderer.shade_frame(variant, (view, light), (Seeding::Frozen, [number, 0]))?;
        let mask = Image::from_pixels(width, height, shaded.values);
        write_exr(&folder.join(format!("mask.{number:04}.exr")), &[("visibility.V".into(), mask)])?;
    }
    Ok(())
}
