//! What is shown of a window: planes of its middle frame.

use super::window::Window;
use crate::error::CliError;
use std::path::Path;
use umbrage_frame::{Image, write_exr};
use umbrage_metrics::PointMaps;
use umbrage_report::VariantPictures;
use umbrage_shadows::{Renderer, Seeding, VariantId};

/// Truth at each anchor's pixel; NaN where nothing is seen.
pub(super) fn truth(window: &Window) -> Image<f32> {
    window.spread(|point| window.truth.mean(point) as f32, f32::NAN)
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
    VariantPictures { mask, error, swim }
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
