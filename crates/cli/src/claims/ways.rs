//! The ways in which a variant is measured in a window.

use super::measurements::PlaceFacts;
use super::store::Unit;
use crate::error::CliError;
use crate::run::panel::{Draw, Reading, shade_panel};
use crate::run::window::Window;
use crate::suite::Sampling;
use std::collections::BTreeMap;
use umbrage_metrics::{
    Panel, SumKind, against_sums, block_sums, point_maps, value_sums, width_sums, window_profiles,
    window_tiles,
};
use umbrage_shadows::{Renderer, Seeding, VariantId};

/// What is known of a window besides its variants.
pub(super) fn facts(window: &Window) -> PlaceFacts {
    let truth = |point: usize| match window.is_counted(point) {
        true => window.truth.mean(point) as f32,
        false => f32::NAN,
    };
    PlaceFacts {
        truth: window.spread(truth, f32::NAN),
        tiles: window.tiling.tiles.iter().filter(|t| !t.penumbra.is_empty()).count() as u32,
        frames: window.frames.len() as u32,
    }
}

/// Patterns drawn afresh.
fn fresh(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
    (reading, sampling): (Reading, &Sampling),
) -> Result<Panel, CliError> {
    let seeds = if variant.info().stochastic { sampling.seeds } else { 1 };
    let draw =
        Draw { seeding: Seeding::Fresh, seeds, first_seed: 0, frames: window.frames.len(), plant: None };
    shade_panel(window, (variant, renderer), reading, draw)
}

/// What an eye sees of patterns drawn afresh: whole frames, each point at its nearest pixel.
pub(super) fn pixels(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
    sampling: &Sampling,
) -> Result<Unit, CliError> {
    let panel = fresh(window, (variant, renderer), (Reading::Pixels, sampling))?;
    in_pixels(window, &panel, SumKind::Pixels)
}

/// The same of one pattern, frame after frame.
pub(super) fn frozen_pixels(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
) -> Result<Unit, CliError> {
    let draw =
        Draw { seeding: Seeding::Frozen, seeds: 1, first_seed: 0, frames: window.frames.len(), plant: None };
    let panel = shade_panel(window, (variant, renderer), Reading::Pixels, draw)?;
    in_pixels(window, &panel, SumKind::FrozenPixels)
}

/// Against the truth of each frame's own pixels; that of the anchors for a window of one frame, where
/// both are the same.
fn in_pixels(window: &Window, panel: &Panel, kind: SumKind) -> Result<Unit, CliError> {
    let truth = window.pixel_truth.as_ref().unwrap_or(&window.truth);
    let table = window_tiles(panel, truth, &window.tiling)?.sum_table();
    Ok(Unit { tables: BTreeMap::from([(kind, table)]), mask: vec![] })
}

/// Everything that follows from patterns drawn afresh, and the middle frame as a game would show it.
pub(super) fn scores(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
    sampling: &Sampling,
) -> Result<Unit, CliError> {
    let panel = fresh(window, (variant, renderer), (Reading::Anchored, sampling))?;
    let (truth, tiling, anchors) = (&window.truth, &window.tiling, &window.anchors);
    let maps = point_maps(&panel, truth, tiling)?;
    let tables = BTreeMap::from([
        (SumKind::Cells, window_tiles(&panel, truth, tiling)?.sum_table()),
        (SumKind::Profile, window_profiles(&panel, truth, anchors, tiling)?.sum_table()),
        (SumKind::Blocks, block_sums(&panel, truth, tiling)?),
        (SumKind::Widths, width_sums((&panel, &maps), truth, anchors, tiling)?),
    ]);
    let shipped = (Seeding::Frozen, [window.first + window.middle() as u32, 0]);
    renderer.set_past(window.past(window.middle()));
    let values = renderer.shade_frame(variant, window.middle_frame(), shipped)?.values;
    let mask = values.iter().map(|v| (255.0 * v.clamp(0.0, 1.0)).round() as u8).collect();
    Ok(Unit { tables, mask })
}

/// What an eye follows: one pattern, frame after frame.
pub(super) fn frozen(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
) -> Result<Unit, CliError> {
    let draw =
        Draw { seeding: Seeding::Frozen, seeds: 1, first_seed: 0, frames: window.frames.len(), plant: None };
    let panel = shade_panel(window, (variant, renderer), Reading::Anchored, draw)?;
    let table = window_tiles(&panel, &window.truth, &window.tiling)?.sum_table();
    Ok(Unit { tables: BTreeMap::from([(SumKind::Frozen, table)]), mask: vec![] })
}

/// What a probe counts.
pub(super) fn values(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
    sampling: &Sampling,
) -> Result<Unit, CliError> {
    let table =
        value_sums(&fresh(window, (variant, renderer), (Reading::Anchored, sampling))?, &window.tiling)?;
    Ok(Unit { tables: BTreeMap::from([(SumKind::Values, table)]), mask: vec![] })
}

/// Two variants at the same points.
pub(super) fn against(
    window: &Window,
    (variant, other): (VariantId, VariantId),
    (renderer, sampling): (&mut Renderer<'_>, &Sampling),
) -> Result<Unit, CliError> {
    let panel = fresh(window, (variant, renderer), (Reading::Anchored, sampling))?;
    let other = fresh(window, (other, renderer), (Reading::Anchored, sampling))?;
    let table = against_sums(&panel, &other, &window.tiling)?;
    Ok(Unit { tables: BTreeMap::from([(SumKind::Against, table)]), mask: vec![] })
}
