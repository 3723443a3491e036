//! What explains a score (METRICS section 3), and what the eye may think.

use super::window::Window;
use crate::error::CliError;
use std::collections::BTreeMap;
use umbrage_frame::Image;
use umbrage_metrics::{Measurement, Panel, PointMaps};
use umbrage_shadows::{Renderer, VariantId};

/// Measurements by metric id.
type Extras = BTreeMap<String, Measurement>;

/// From the anchored panel: tails, widths, levels, spectra.
pub(super) fn of_panel(_window: &Window, _panel: &Panel, _maps: &PointMaps) -> Result<Extras, CliError> {
    Ok(Extras::new())
}

/// From a frame as a game would show it: FLIP and SSIM.
pub(super) fn of_picture(_window: &Window, _mask: &Image<f32>) -> Extras {
    Extras::new()
}

/// From frozen and animated patterns: how the noise is anchored.
pub(super) fn of_patterns(
    _window: &Window,
    _variant: (VariantId, &mut Renderer<'_>),
    _maps: &PointMaps,
) -> Result<Extras, CliError> {
    Ok(Extras::new())
}
