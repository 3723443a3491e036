//! The folder of a run: `scorecard.json` and the planes of its pictures.
//!
//! Planes are EXR files of 32-bit floats rounded to 11 significant bits (those of a half float):
//! the zeroed bits compress away, any EXR viewer opens them, and NaN stays NaN.

mod paths;
mod read;

pub(crate) use paths::{CellsOf, scorecard_path};
pub(crate) use read::{read_cells, read_index, read_series, read_truth_series, read_variant, read_window};

use crate::error::{ReportError, write_whole};
use crate::gate::{CROPS, GATE, SUMS};
use crate::{SCHEMA_VERSION, Scorecard};
use paths::{cells_path, series_path, truth_path, truth_series_path, variant_path};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use umbrage_frame::{Image, Layer, write_exr};

/// What is shown of a window besides its variants. NaN = not counted.
#[derive(Clone, Debug)]
pub struct WindowPictures {
    /// The true unoccluded fraction at each anchor's pixel in the middle frame, 0 to 1.
    pub truth: Image<f32>,
    /// The same frame by frame where the light moves; otherwise empty.
    pub truth_series: Vec<Image<f32>>,
    /// The scene as seen, display-linear RGB, 1 = white; optional.
    pub beauty: Option<Image<[f32; 3]>>,
    /// Where the points lie, and how sure their truth is; optional.
    pub surface: Option<Surface>,
}

/// What the viewer says about a point besides its shadow, each at the middle frame's pixels.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Linear depth in metres; NaN where nothing is seen.
    pub depth: Image<f32>,
    /// [`Surface::LEFT_OUT`], [`Surface::UMBRA`], [`Surface::PENUMBRA`], [`Surface::LIT`]; NaN where nothing is seen.
    pub region: Image<f32>,
    /// Standard error of truth (visibility); NaN where nothing is seen.
    pub truth_error: Image<f32>,
    /// True 10-90 % width of the penumbra in metres on the surface; NaN where it is not defined.
    pub width: Option<Image<f32>>,
    /// World to clip space of each frame of the window, columns one after the other.
    pub cameras: Vec<[f32; 16]>,
}

impl Surface {
    /// Seen, but not scored.
    pub const LEFT_OUT: f32 = 0.0;
    /// Dark.
    pub const UMBRA: f32 = 1.0;
    /// Between dark and lit.
    pub const PENUMBRA: f32 = 2.0;
    /// Lit.
    pub const LIT: f32 = 3.0;
}

/// What is shown of a variant in a window, each in the middle frame. NaN = not counted.
#[derive(Clone, Debug)]
pub struct VariantPictures {
    /// The variant's unoccluded fraction, 0 to 1, also where it is not counted; NaN = nothing seen.
    pub mask: Image<f32>,
    /// Variant minus truth, -1 to 1.
    pub error: Image<f32>,
    /// Root of the moving part per anchor (visibility), from 0; none when it was not measured.
    pub swim: Option<Image<f32>>,
    /// The variant at every point of the middle frame, frame by frame, as a game would ship it; empty
    /// when it was not kept.
    pub series: Vec<Image<f32>>,
    /// Where each cell of the squared error lies.
    pub cells: CellMaps,
}

/// The cells of the squared error as maps (visibility squared), in the order of [`CELLS`]. NaN = not counted, or
/// not measured; small negative values are legal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellMaps {
    /// At each anchor's pixel in the middle frame; empty when not kept.
    pub pixels: Vec<Image<f32>>,
    /// The mean over the penumbra of each tile, a pixel a tile; empty when not kept.
    pub tiles: Vec<Image<f32>>,
}

/// Metric ids of the cells, which add up to the squared error.
pub const CELLS: [&str; 5] =
    ["smooth_static", "structured_static", "smooth_moving", "structured_moving", "noise"];

/// Fills the folder of a run, picture by picture, so that never more than one is in memory.
#[derive(Debug)]
pub struct RunWriter {
    folder: PathBuf,
    index: PictureIndex,
}

/// Which pictures are stored, and the ranges that their colours need.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct PictureIndex {
    pub(crate) schema_version: u32,
    /// Windows that have a truth picture; true when there is a beauty picture too.
    pub(crate) windows: Vec<(usize, bool)>,
    pub(crate) variants: Vec<StoredVariant>,
    /// World to clip space of the frames of a window.
    #[serde(default)]
    pub(crate) cameras: BTreeMap<usize, Vec<[f32; 16]>>,
    /// Windows whose truth is stored frame by frame.
    #[serde(default)]
    pub(crate) truth_series: Vec<usize>,
}

/// A stored variant, with the 99.5th percentiles of |error| and swim.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct StoredVariant {
    pub(crate) window: usize,
    pub(crate) variant: usize,
    pub(crate) error_p995: f32,
    pub(crate) swim_p995: Option<f32>,
    /// Frames that are stored.
    #[serde(default)]
    pub(crate) frames: usize,
    /// Whether the cells are stored, by pixel and by tile.
    #[serde(default)]
    pub(crate) cells: [bool; 2],
}

const INDEX: &str = "index.json";

/// What an earlier run in the same folder came to must not pass for what this one does, if it breaks off.
fn forget_earlier(folder: &Path) -> Result<(), ReportError> {
    let gone = |path: PathBuf, removed: std::io::Result<()>| match removed {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(ReportError::at(&path)(e)),
        _ => Ok(()),
    };
    let crops = folder.join(CROPS);
    gone(crops.clone(), std::fs::remove_dir_all(&crops))?;
    [scorecard_path(folder), folder.join(GATE), folder.join(SUMS)].into_iter().try_for_each(|file| {
        let removed = std::fs::remove_file(&file);
        gone(file, removed)
    })
}

impl RunWriter {
    /// Makes the folder of a run (an existing one is used; its pages are replaced at the end).
    ///
    /// # Errors
    /// A folder that cannot be made or written to: found out here, not after an hour of rendering.
    pub fn create(folder: &Path) -> Result<Self, ReportError> {
        let pictures = folder.join("pictures");
        std::fs::create_dir_all(&pictures).map_err(ReportError::at(&pictures))?;
        forget_earlier(folder)?;
        let index = PictureIndex { schema_version: SCHEMA_VERSION, ..PictureIndex::default() };
        let writer = Self { folder: folder.into(), index };
        writer.save_index()?;
        Ok(writer)
    }

    /// Where the run is stored.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Stores what is shown of a window. `window` is its place in the scorecard.
    ///
    /// # Errors
    /// Pictures of unequal sizes, or a file that cannot be written.
    pub fn window_pictures(&mut self, window: usize, pictures: &WindowPictures) -> Result<(), ReportError> {
        let mut layers = vec![layer("reference.V", &pictures.truth)];
        if let Some(beauty) = &pictures.beauty {
            let channels = ["R", "G", "B"].into_iter().enumerate();
            layers.extend(channels.map(|(c, name)| layer(name, &beauty.map(|rgb| rgb[c]))));
        }
        if let Some(surface) = &pictures.surface {
            let Surface { depth, region, truth_error, width, cameras } = surface;
            // Depth keeps all its bits: world positions come from it.
            layers.push(("depth.Z".into(), depth.clone()));
            layers.extend([layer("region.V", region), layer("deviation.V", truth_error)]);
            layers.extend(width.as_ref().map(|width| layer("width.V", width)));
            self.index.cameras.insert(window, cameras.clone());
        }
        write_exr(&truth_path(&self.folder, window), &layers)?;
        if !pictures.truth_series.is_empty() {
            write_exr(&truth_series_path(&self.folder, window), &series(&pictures.truth_series))?;
            self.index.truth_series.push(window);
        }
        self.index.windows.push((window, pictures.beauty.is_some()));
        Ok(())
    }

    /// Stores what is shown of a variant in a window, by their places in the scorecard.
    ///
    /// # Errors
    /// Pictures of unequal sizes, or a file that cannot be written.
    pub fn variant_pictures(
        &mut self,
        window: usize,
        variant: usize,
        pictures: &VariantPictures,
    ) -> Result<(), ReportError> {
        let VariantPictures { mask, error, swim, series: frames, cells } = pictures;
        let mut layers = vec![layer("visibility.V", mask), layer("error.V", error)];
        layers.extend(swim.as_ref().map(|swim| layer("swim.V", swim)));
        write_exr(&variant_path(&self.folder, window, variant), &layers)?;
        if !frames.is_empty() {
            write_exr(&series_path(&self.folder, window, variant), &series(frames))?;
        }
        for (of, maps) in [(CellsOf::Pixels, &cells.pixels), (CellsOf::Tiles, &cells.tiles)] {
            if !maps.is_empty() {
                let layers: Vec<Layer> =
                    CELLS.iter().zip(maps).map(|(id, map)| layer(&format!("{id}.V"), map)).collect();
                write_exr(&cells_path(&self.folder, (window, variant), of), &layers)?;
            }
        }
        let (error_p995, swim_p995) = (upper_percentile(error), swim.as_ref().map(upper_percentile));
        self.index.variants.push(StoredVariant {
            window,
            variant,
            error_p995,
            swim_p995,
            frames: frames.len(),
            cells: [!cells.pixels.is_empty(), !cells.tiles.is_empty()],
        });
        Ok(())
    }

    /// Stores the scorecard: the run is complete. [`crate::write_report`] makes the pages.
    ///
    /// # Errors
    /// As [`Scorecard::save`].
    pub fn finish(self, scorecard: &Scorecard) -> Result<(), ReportError> {
        self.save_index()?;
        scorecard.save(&scorecard_path(&self.folder))
    }

    fn save_index(&self) -> Result<(), ReportError> {
        let path = self.folder.join("pictures").join(INDEX);
        let text = serde_json::to_string_pretty(&self.index);
        let text = text.map_err(|e| ReportError::Contradiction(e.to_string()))?;
        write_whole(&path, text.as_bytes())
    }
}

/// Frames as layers, `t0000.V` first.
fn series(frames: &[Image<f32>]) -> Vec<Layer> {
    frames.iter().enumerate().map(|(t, frame)| layer(&format!("t{t:04}.V"), frame)).collect()
}

fn layer(name: &str, image: &Image<f32>) -> Layer {
    (name.to_string(), image.map(|&v| rounded(v)))
}

/// Rounds to the 11 significant bits of a half float: 23 stored bits less 10 leave 13 to zero.
fn rounded(value: f32) -> f32 {
    if !value.is_finite() {
        return f32::NAN;
    }
    f32::from_bits((value.to_bits() + (1 << 12)) & !((1 << 13) - 1))
}

/// The 99.5th percentile of |v| over what counts; 0 when nothing does.
fn upper_percentile(image: &Image<f32>) -> f32 {
    let mut values: Vec<f32> = image.pixels().iter().map(|v| v.abs()).filter(|v| v.is_finite()).collect();
    if values.is_empty() {
        return 0.0;
    }
    let place = (values.len() - 1) * 995 / 1000;
    *values.select_nth_unstable_by(place, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_come_back_to_eleven_bits_and_nan_stays_nan() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let mut writer = RunWriter::create(folder.path()).expect("made");
        let ramp = Image::from_fn(9, 4, |x, y| if x == 0 { f32::NAN } else { x as f32 / 9.0 - y as f32 });
        let pictures = VariantPictures {
            mask: ramp.clone(),
            error: ramp.clone(),
            swim: None,
            series: vec![ramp.clone(), ramp.map(|v| 2.0 * v)],
            cells: CellMaps { pixels: vec![], tiles: vec![Image::filled(2, 1, 0.25); 5] },
        };
        writer.variant_pictures(3, 7, &pictures).expect("written");
        let back = read_variant(folder.path(), 3, 7).expect("read");
        assert_eq!(back.swim, None);
        let tiles = read_cells(folder.path(), (3, 7), CellsOf::Tiles).expect("read");
        assert_eq!(tiles, vec![Image::filled(2, 1, 0.25); 5]);
        let frames = read_series(folder.path(), 3, 7).expect("read");
        assert_eq!(
            frames.iter().map(|f| *f.at(8, 0)).collect::<Vec<_>>(),
            [8.0 / 9.0, 16.0 / 9.0].map(rounded)
        );
        for (a, b) in back.error.pixels().iter().zip(ramp.pixels()) {
            // Half a unit in the last of 11 bits; a lost bit would be twice that.
            assert!(a.is_nan() && b.is_nan() || (a - b).abs() <= b.abs() * 0.5f32.powi(11), "{a} {b}");
        }
    }

    #[test]
    fn percentile_ignores_what_does_not_count() {
        let image = Image::from_fn(1000, 1, |x, _| if x % 2 == 0 { f32::NAN } else { -(x as f32) });
        // Odd numbers 1 to 999: index 496 of 0 to 499 is 2 * 496 + 1.
        assert_eq!(upper_percentile(&image), 993.0);
        assert_eq!(upper_percentile(&Image::filled(2, 2, f32::NAN)), 0.0);
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_an_error_that_names_it() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("a-file");
        std::fs::write(&file, "x").expect("written");
        assert!(RunWriter::create(&file).expect_err("a file").to_string().contains("a-file"));
    }
}
