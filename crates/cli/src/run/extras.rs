//! What explains a score (METRICS section 3), and what the eye may think.

use super::panel::{Draw, Reading, shade_panel};
use super::window::Window;
use crate::error::CliError;
use std::collections::BTreeMap;
use umbrage_frame::Image;
use umbrage_metrics::{
    Bootstrap, Measurement, Missing, Panel, PointMaps, ProfileTable, Score, Tail, TileTable, Viewing, flip,
    grain, percentile, profiles, ssim, window_grain, window_tails, worst_tile,
};
use umbrage_shadows::{Renderer, Seeding, VariantId};

/// Measurements by metric id.
type Extras = BTreeMap<String, Measurement>;

/// Frames and seeds of the runs that tell how noise is anchored: each of thousands of points gives
/// a product per pair of frames.
pub(super) const PATTERN_FRAMES: usize = 4;
/// See `PATTERN_FRAMES`.
pub(super) const PATTERN_SEEDS: u32 = 2;

/// From the anchored panel: tails, widths, levels, the colour of the noise and its spectrum.
pub(super) fn of_panel(
    window: &Window,
    (panel, table): (&Panel, &ProfileTable),
    maps: &PointMaps,
) -> Result<(Extras, Vec<f64>), CliError> {
    let bootstrap = Bootstrap::default();
    let tails = window_tails(maps, &window.tiling);
    let shape = profiles(&[table], &bootstrap);
    let mut extras = BTreeMap::from([
        ("p95".to_string(), percentile(&[&tails], Tail::Error, 0.95, &bootstrap)),
        ("p99".to_string(), percentile(&[&tails], Tail::Error, 0.99, &bootstrap)),
        ("light_leak_p99".to_string(), percentile(&[&tails], Tail::LightLeak, 0.99, &bootstrap)),
        ("false_shadow_p99".to_string(), percentile(&[&tails], Tail::FalseShadow, 0.99, &bootstrap)),
        ("width_ratio".to_string(), shape.width_ratio),
        ("width_anisotropy".to_string(), shape.width_anisotropy),
        ("effective_levels".to_string(), shape.effective_levels),
        ("plateau_fraction".to_string(), shape.plateau_fraction),
    ]);
    let (noise, spectrum) = match panel.seeds {
        1 => (Measurement::NotMeasured(Missing::NoNoise), Vec::new()),
        _ => {
            let grain = grain(&[&window_grain(panel, &window.tiling)?], &bootstrap);
            (grain.after_blur, grain.spectrum)
        }
    };
    extras.insert("noise_after_blur".into(), noise);
    Ok((extras, spectrum))
}

/// The tile with the largest ERROR.
pub(super) fn worst(table: &TileTable) -> Result<Measurement, CliError> {
    let worst = worst_tile(&[table])?;
    let score = worst.map(|tile| Measurement::Measured(Score::exact(tile.error)));
    Ok(score.unwrap_or(Measurement::NotMeasured(Missing::NoPenumbra)))
}

/// From a frame as a game would show it, where it counts: FLIP of the shaded scene, SSIM of the
/// mask.
pub(super) fn of_picture(window: &Window, mask: &Image<f32>) -> Extras {
    let bootstrap = Bootstrap::default();
    // What is not scored is shown with its true shadow: it must not speak here either.
    let truth = window.spread(|point| window.truth.mean(point) as f32, 1.0);
    let mut shown = truth.clone();
    for point in (0..window.anchors.len()).filter(|&p| window.is_counted(p)) {
        let pixel = window.anchors.pixel[point] as usize;
        shown.pixels_mut()[pixel] = mask.pixels()[pixel];
    }
    let vectors = |mask| window.shaded(mask).map(|&rgb| glam::Vec3::from(rgb));
    let flipped = flip(&vectors(&truth), &vectors(&shown), Viewing::default(), &bootstrap);
    let similar = ssim(&truth, &shown, &bootstrap);
    // Pictures smaller than their windows have no such score; the other scores do not depend on it.
    let measured =
        |score: Result<umbrage_metrics::PictureScore, _>| score.map(|s| Measurement::Measured(s.mean));
    let pairs = [("flip", measured(flipped)), ("ssim", measured(similar))];
    pairs.into_iter().filter_map(|(id, m)| Some((id.to_string(), m.ok()?))).collect()
}

/// From patterns as games ship them, frozen and animated: does the noise stick to the screen, to
/// the world, or to neither.
pub(super) fn of_patterns(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
) -> Result<Extras, CliError> {
    let runs = [
        ("lag1_pixel_frozen", Seeding::Frozen, Reading::FixedPixels),
        ("lag1_point_frozen", Seeding::Frozen, Reading::Anchored),
        ("lag1_pixel_animated", Seeding::Animated, Reading::FixedPixels),
        ("lag1_point_animated", Seeding::Animated, Reading::Anchored),
    ];
    let frames = window.frames.len().min(PATTERN_FRAMES);
    let mut extras = Extras::new();
    for (id, seeding, reading) in runs {
        if frames < 2 {
            extras.insert(id.into(), Measurement::NotMeasured(Missing::OneFrame));
            continue;
        }
        let draw = Draw { seeding, seeds: PATTERN_SEEDS, first_seed: 0, frames, plant: None };
        let panel = shade_panel(window, (variant, renderer), reading, draw)?;
        let table = window_grain(&panel, &window.tiling)?;
        extras.insert(id.into(), grain(&[&table], &Bootstrap::default()).lag1);
    }
    Ok(extras)
}
