//! What a variant says at every anchor, frame and seed, in both readings.

use super::plant;
use super::window::Window;
use crate::args::Plant;
use crate::error::CliError;
use umbrage_metrics::Panel;
use umbrage_shadows::{Renderer, Seeding, VariantId};

/// Where a value is taken.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Reading {
    /// At the anchor's own place: the last pass is dispatched over the anchors.
    Anchored,
    /// At the nearest pixel of a whole frame, as any picture from elsewhere must be read.
    Pixels,
    /// At the anchor's pixel in the middle frame, in every frame: what stands still on the screen.
    FixedPixels,
}

/// How patterns are drawn, and for how many frames from the start of the window.
#[derive(Clone, Copy)]
pub(crate) struct Draw {
    pub(crate) seeding: Seeding,
    pub(crate) seeds: u32,
    /// Of fresh patterns; as they ship they begin at 0.
    pub(crate) first_seed: u32,
    pub(crate) frames: usize,
    pub(crate) plant: Option<Plant>,
}

/// Shades every frame and seed.
pub(crate) fn shade_panel(
    window: &Window,
    (variant, renderer): (VariantId, &mut Renderer<'_>),
    reading: Reading,
    draw: Draw,
) -> Result<Panel, CliError> {
    let points = window.anchors.len();
    if points == 0 {
        // A pass over no anchors would still answer for one.
        return Ok(Panel { points, frames: draw.frames, seeds: draw.seeds as usize, values: vec![] });
    }
    let mut values = Vec::with_capacity(points * draw.frames * draw.seeds as usize);
    for (frame, (view, light)) in window.frames.iter().take(draw.frames).enumerate() {
        renderer.set_past(window.past(frame));
        let light = &plant::light(draw.plant, light);
        let start = values.len();
        let pixels = match reading {
            Reading::Anchored => None,
            Reading::Pixels => Some(window.anchors.pixels_in(view)),
            Reading::FixedPixels => Some(window.anchors.pixel.iter().map(|&p| Some(p)).collect()),
        };
        for seed in 0..draw.seeds {
            // Scores draw afresh in each window; a pattern as it ships has seed 0.
            let salt =
                if draw.seeding == Seeding::Fresh { window.salt().wrapping_add(draw.first_seed) } else { 0 };
            let pattern = (draw.seeding, [window.first + frame as u32, salt.wrapping_add(seed)]);
            match &pixels {
                None => values.extend(renderer.shade_anchors(variant, (view, light), pattern)?.values),
                Some(pixels) => {
                    let shaded = renderer.shade_frame(variant, (view, light), pattern)?.values;
                    // An anchor outside the picture is never counted.
                    values.extend(pixels.iter().map(|p| p.map_or(0.0, |p| shaded[p as usize])));
                }
            }
        }
        if draw.plant == Some(Plant::BrokenFrame) && frame == window.middle() {
            values[start..].fill(1.0);
        }
    }
    Ok(Panel { points, frames: draw.frames, seeds: draw.seeds as usize, values })
}
