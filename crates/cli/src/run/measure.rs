//! One variant in one window: shaded, reduced to tile sums, described.

use super::extras;
use super::panel::{Draw, Reading, shade_panel};
use super::pictures;
use super::window::Window;
use crate::error::CliError;
use crate::suite::Sampling;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use umbrage_frame::Image;
use umbrage_metrics::{
    Measurement, Panel, PanelTruth, PointMaps, SeedSpread, SumTable, TileTable, block_sums, point_maps,
    seed_spread, window_profiles, window_tiles,
};
use umbrage_report::{CellMaps, VariantPictures};
use umbrage_shadows::{Renderer, Seeding, VariantId};

/// Everything that is kept of a variant in a window.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    pub(crate) numbers: Numbers,
    pub(super) pictures: VariantPictures,
}

/// The small part, for scores and paired tests.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Numbers {
    /// The anchored reading.
    pub(crate) anchored: TileTable,
    /// What the width of the penumbra is made of.
    pub(crate) profile: SumTable,
    /// What the noise of means over 4x4 px is made of.
    pub(crate) blocks: SumTable,
    /// Spread of each gated number over seeds; none with two seeds.
    pub(crate) spread: Option<Vec<Option<SeedSpread>>>,
    /// The pixel reading; none for one frame.
    pub(crate) pixels: Option<TileTable>,
    /// What explains the scores, by metric id.
    pub(crate) extras: BTreeMap<String, Measurement>,
    /// Power of the noise over spatial frequency, white = 1; empty without noise.
    pub(crate) noise_spectrum: Vec<f64>,
}

impl Measured {
    /// Pictures go to disk one by one; numbers stay.
    pub(super) fn without_pictures(self) -> Self {
        let none = || Image::from_pixels(0, 0, vec![]);
        let cells = CellMaps::default();
        let pictures = VariantPictures { mask: none(), error: none(), swim: None, series: vec![], cells };
        Self { pictures, ..self }
    }
}

/// Shades and scores.
pub(super) fn measure(
    window: &Window,
    variant: VariantId,
    renderer: &mut Renderer<'_>,
    sampling: &Sampling,
) -> Result<Measured, CliError> {
    let seeds = if variant.info().stochastic { sampling.seeds } else { 1 };
    let first_seed = sampling.first_seed.wrapping_mul(sampling.seeds);
    let draw = Draw {
        seeding: Seeding::Fresh,
        seeds,
        first_seed,
        frames: window.frames.len(),
        plant: sampling.plant,
    };
    let panel = shade_panel(window, (variant, renderer), Reading::Anchored, draw)?;
    let (mut numbers, maps) = reduced(window, &panel, (&window.truth, (&panel, &window.truth)))?;
    let (view, light) = &window.frames[window.middle()];
    renderer.set_past(window.past(window.middle()));
    let shipped = (Seeding::Frozen, [window.first + window.middle() as u32, 0]);
    let values = renderer.shade_frame(variant, (view, light), shipped)?.values;
    let (width, height) = window.size();
    let mask = Image::from_pixels(width, height, values);
    numbers.extras.extend(extras::of_picture(window, &mask));
    drop(panel);
    if variant.info().stochastic {
        numbers.extras.extend(extras::of_patterns(window, (variant, renderer))?);
    }
    numbers.pixels = match &window.pixel_truth {
        None => None,
        Some(truth) => {
            let panel = shade_panel(window, (variant, renderer), Reading::Pixels, draw)?;
            Some(window_tiles(&panel, truth, &window.tiling)?)
        }
    };
    let mut pictures = pictures::variant(window, mask, &maps);
    pictures.series = pictures::series(window, (variant, renderer), sampling.plant)?;
    Ok(Measured { numbers, pictures })
}

/// What a panel comes to, and where. Widths are those of `sharp`, a panel that is read at the anchors
/// themselves: at the nearest pixel edges move to and fro, and their mean is wider than any of them.
pub(super) fn reduced(
    window: &Window,
    panel: &Panel,
    (truth, sharp): (&PanelTruth, (&Panel, &PanelTruth)),
) -> Result<(Numbers, PointMaps), CliError> {
    let (anchors, tiling) = (&window.anchors, &window.tiling);
    let anchored = window_tiles(panel, truth, tiling)?;
    let maps = point_maps(panel, truth, tiling)?;
    let profile = window_profiles(sharp.0, sharp.1, anchors, tiling)?;
    let (mut extras, noise_spectrum) = extras::of_panel(window, (panel, &profile), &maps)?;
    extras.insert("worst_tile".into(), extras::worst(&anchored)?);
    let numbers = Numbers {
        anchored,
        profile: profile.sum_table(),
        blocks: block_sums(panel, truth, tiling)?,
        spread: seed_spread(panel, truth, anchors, tiling)?,
        pixels: None,
        extras,
        noise_spectrum,
    };
    Ok((numbers, maps))
}
