//! Pictures of what regressed, from what is stored of the run.

use super::card::GateCard;
use crate::error::{ReportError, write_whole};
use crate::store::{read_index, read_variant, read_window};
use crate::{Crop, CropPanel, Scorecard};
use std::path::Path;
use umbrage_frame::Image;
use umbrage_metrics::Verdict;

/// As many as a person looks at.
const MOST: usize = 24;
pub(crate) const FOLDER: &str = "gate";

/// Writes `gate/*.png` for the first cases that regressed, and their names into the card.
///
/// # Errors
/// A stored picture that cannot be read, or a file that cannot be written.
pub fn write_gate_crops(run: &Path, card: &mut GateCard, scores: &Scorecard) -> Result<(), ReportError> {
    let index = read_index(run)?;
    if run.join(FOLDER).exists() {
        std::fs::remove_dir_all(run.join(FOLDER)).map_err(ReportError::at(run))?;
    }
    let regressed = |c: &super::GateCase| c.change.is_some_and(|c| c.verdict == Verdict::Regressed);
    let mut written = 0;
    for case in card.cases.iter_mut().filter(|c| regressed(c)) {
        let Some(place) = case.worst_place else { continue };
        let window = scores.windows.iter().position(|w| {
            Some(&w.scene) == case.scene.as_ref()
                && Some(&w.path) == case.path.as_ref()
                && Some(w.first_frame) == case.first_frame
        });
        let name = |v: &crate::VariantCard| format!("{}/{}", v.name, v.calibration.id());
        let variant = scores.variants.iter().position(|v| name(v) == case.variant);
        let (Some(window), Some(variant)) = (window, variant) else { continue };
        let stored = index.variants.iter().any(|s| s.window == window && s.variant == variant);
        if written == MOST || !stored {
            continue;
        }
        let truth = read_window(run, window)?.truth;
        let mask = read_variant(run, window, variant)?.mask;
        let panel =
            |label: &str, plane: &Image<f32>| CropPanel { label: label.into(), plane: cut(plane, place) };
        let crop = Crop {
            panels: vec![panel("truth", &truth), panel(&case.variant, &mask)],
            caption: String::new(),
        };
        let folder = run.join(FOLDER);
        std::fs::create_dir_all(&folder).map_err(ReportError::at(&folder))?;
        let file = format!("{FOLDER}/{written:02}.png");
        write_whole(&run.join(&file), &crop.png(&case.variant)?)?;
        case.crop = Some(file);
        written += 1;
    }
    Ok(())
}

/// The part of a picture inside a rectangle.
fn cut(plane: &Image<f32>, [left, top, width, height]: [u32; 4]) -> Image<f32> {
    let (right, bottom) = ((left + width).min(plane.width()), (top + height).min(plane.height()));
    let (left, top) = (left.min(right), top.min(bottom));
    Image::from_fn(right - left, bottom - top, |x, y| *plane.at(left + x, top + y))
}
