//! The picture beside a claim: a few crops in a row, magnified so that single pixels show.

use crate::ReportError;
use crate::picture::{Scale, png_of};
use umbrage_frame::Image;

/// How many times a crop is magnified, by repeating pixels.
const TIMES: u32 = 3;
/// Between crops, in pixels of the page.
const GAP: u32 = 6;

/// Crops of equal size, left to right.
#[derive(Clone, Debug)]
pub struct Crop {
    /// Truth first.
    pub panels: Vec<CropPanel>,
    /// What it shows and where.
    pub caption: String,
}

/// One of them.
#[derive(Clone, Debug)]
pub struct CropPanel {
    /// "truth", or the variant.
    pub label: String,
    /// Visibility, NaN where nothing counts.
    pub plane: Image<f32>,
}

impl Crop {
    /// The caption with the panels' labels.
    pub(super) fn words(&self) -> String {
        let labels: Vec<&str> = self.panels.iter().map(|p| p.label.as_str()).collect();
        format!("{}. Left to right: {}.", self.caption, labels.join("; "))
    }

    /// As a PNG file.
    pub(crate) fn png(&self, name: &str) -> Result<Vec<u8>, ReportError> {
        let size = |of: fn(&Image<f32>) -> u32| self.panels.iter().map(|p| of(&p.plane)).max().unwrap_or(1);
        let (width, height) = (size(Image::width) * TIMES, size(Image::height) * TIMES);
        let count = self.panels.len().max(1) as u32;
        let value = |x: u32, y: u32| {
            let (panel, inside) = (x / (width + GAP), x % (width + GAP));
            let plane = self.panels.get(panel as usize).map(|p| &p.plane);
            let (column, row) = (inside / TIMES, y / TIMES);
            match plane {
                Some(plane) if inside < width && column < plane.width() && row < plane.height() => {
                    *plane.at(column, row)
                }
                // Between crops the page shows white.
                _ => 1.0,
            }
        };
        let whole = Image::from_fn(count * (width + GAP) - GAP, height, value);
        png_of(name, &whole, Scale::SHADOW)
    }
}
