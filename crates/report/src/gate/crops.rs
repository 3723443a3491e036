//! Pictures of what regressed: before, after and the truth, from what is stored of the two runs.

use super::card::{GateCard, GateCase};
use crate::error::{ReportError, write_whole};
use crate::store::{PictureIndex, read_index, read_variant, read_window, scorecard_path};
use crate::{Crop, CropPanel, Scorecard};
use std::path::Path;
use umbrage_frame::Image;
use umbrage_metrics::Verdict;

/// As many as a person looks at.
const MOST: usize = 24;
pub(crate) const FOLDER: &str = "gate";
/// The baseline's own picture.
pub(crate) const BEFORE: &str = "before";

/// A run with its pictures.
struct Stored<'a> {
    folder: &'a Path,
    index: PictureIndex,
    card: Scorecard,
}

impl<'a> Stored<'a> {
    fn open(folder: &'a Path) -> Result<Self, ReportError> {
        let (index, card) = (read_index(folder)?, Scorecard::load(&scorecard_path(folder))?);
        Ok(Self { folder, index, card })
    }

    /// Window and variant of a case, where there is a picture of them.
    fn place(&self, case: &GateCase) -> Option<(usize, usize)> {
        let window = self.card.windows.iter().position(|w| {
            Some(&w.scene) == case.scene.as_ref()
                && Some(&w.path) == case.path.as_ref()
                && Some(w.first_frame) == case.first_frame
        })?;
        let name = |v: &crate::VariantCard| format!("{}/{}", v.name, v.calibration.id());
        let variant = self.card.variants.iter().position(|v| name(v) == case.variant)?;
        let stored = self.index.variants.iter().any(|s| s.window == window && s.variant == variant);
        stored.then_some((window, variant))
    }

    fn mask(&self, case: &GateCase) -> Result<Option<Image<f32>>, ReportError> {
        let Some((window, variant)) = self.place(case) else { return Ok(None) };
        Ok(Some(read_variant(self.folder, window, variant)?.mask))
    }
}

/// Writes `gate/*.png` for the first cases that regressed, and their names into the card. `base` is the folder of
/// the run that was the baseline, where it is one: a committed baseline holds sums and no pictures.
///
/// # Errors
/// A stored picture that cannot be read, or a file that cannot be written.
pub fn write_gate_crops(run: &Path, base: Option<&Path>, card: &mut GateCard) -> Result<(), ReportError> {
    let now = Stored::open(run)?;
    // A base whose pictures are gone still has its sums.
    let before = base.and_then(|folder| Stored::open(folder).ok());
    if run.join(FOLDER).exists() {
        std::fs::remove_dir_all(run.join(FOLDER)).map_err(ReportError::at(run))?;
    }
    let regressed = |c: &GateCase| c.change.is_some_and(|c| c.verdict == Verdict::Regressed);
    let mut written = 0;
    for case in card.cases.iter_mut().filter(|c| regressed(c)) {
        let (Some(place), Some((window, _))) = (case.worst_place, now.place(case)) else { continue };
        let Some(mask) = now.mask(case)? else { continue };
        if written == MOST {
            break;
        }
        let mut planes = Vec::new();
        if let Some(old) = before.as_ref().map(|b| b.mask(case)).transpose()?.flatten() {
            planes.push((BEFORE.to_string(), old));
        }
        planes.push((format!("after ({})", case.variant), mask));
        planes.push(("truth".to_string(), read_window(run, window)?.truth));
        let panels =
            planes.iter().map(|(label, plane)| CropPanel { label: label.clone(), plane: cut(plane, place) });
        let crop = Crop { panels: panels.collect(), caption: String::new() };
        let folder = run.join(FOLDER);
        std::fs::create_dir_all(&folder).map_err(ReportError::at(&folder))?;
        let file = format!("{FOLDER}/{written:02}.png");
        write_whole(&run.join(&file), &crop.png(&case.variant)?)?;
        case.crop = Some(file);
        case.crop_shows = planes.into_iter().map(|(label, _)| label).collect();
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
