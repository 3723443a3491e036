//! Reads back what a run stored.

use super::paths::{CellsOf, cells_path, series_path, truth_path, truth_series_path, variant_path};
use super::{CELLS, CellMaps, PictureIndex, Surface, VariantPictures, WindowPictures};
use crate::error::ReportError;
use std::path::Path;
use umbrage_frame::{Image, Layer, read_exr};

/// Which pictures a run has. A run without pictures is legal: it has none.
pub(crate) fn read_index(folder: &Path) -> Result<PictureIndex, ReportError> {
    let path = folder.join("pictures").join(super::INDEX);
    if !path.exists() {
        return Ok(PictureIndex::default());
    }
    let text = std::fs::read_to_string(&path).map_err(ReportError::at(&path))?;
    serde_json::from_str(&text).map_err(|e| ReportError::File { path, reason: e.to_string() })
}

/// Reads back what is shown of a window.
pub(crate) fn read_window(folder: &Path, window: usize) -> Result<WindowPictures, ReportError> {
    let path = truth_path(folder, window);
    let mut layers = read_exr(&path)?;
    let truth = take(&mut layers, "reference.V", &path)?;
    let rgb = ["R", "G", "B"].map(|name| take(&mut layers, name, &path).ok());
    let beauty = match rgb {
        [Some(r), Some(g), Some(b)] => {
            Some(Image::from_fn(r.width(), r.height(), |x, y| [*r.at(x, y), *g.at(x, y), *b.at(x, y)]))
        }
        _ => None,
    };
    let cameras = read_index(folder)?.cameras.remove(&window);
    let mut plane = |name| take(&mut layers, name, &path).ok();
    let width = plane("width.V");
    let surface = match (plane("depth.Z"), plane("region.V"), plane("deviation.V"), cameras) {
        (Some(depth), Some(region), Some(truth_error), Some(cameras)) => {
            Some(Surface { depth, region, truth_error, width, cameras })
        }
        _ => None,
    };
    Ok(WindowPictures { truth, truth_series: Vec::new(), beauty, surface })
}

/// Reads back what is shown of a variant.
pub(crate) fn read_variant(
    folder: &Path,
    window: usize,
    variant: usize,
) -> Result<VariantPictures, ReportError> {
    let path = variant_path(folder, window, variant);
    let mut layers = read_exr(&path)?;
    let mut take = |name| take(&mut layers, name, &path);
    Ok(VariantPictures {
        mask: take("visibility.V")?,
        error: take("error.V")?,
        swim: take("swim.V").ok(),
        series: Vec::new(),
        cells: CellMaps::default(),
    })
}

/// Reads back the frames of a variant: apart from its pictures, for they are large.
pub(crate) fn read_series(
    folder: &Path,
    window: usize,
    variant: usize,
) -> Result<Vec<Image<f32>>, ReportError> {
    frames(&series_path(folder, window, variant))
}

/// Reads back the cells of a variant, in the order of [`CELLS`].
pub(crate) fn read_cells(
    folder: &Path,
    place: (usize, usize),
    of: CellsOf,
) -> Result<Vec<Image<f32>>, ReportError> {
    let path = cells_path(folder, place, of);
    let mut layers = read_exr(&path)?;
    CELLS.iter().map(|id| take(&mut layers, &format!("{id}.V"), &path)).collect()
}

/// Reads back truth frame by frame.
pub(crate) fn read_truth_series(folder: &Path, window: usize) -> Result<Vec<Image<f32>>, ReportError> {
    frames(&truth_series_path(folder, window))
}

fn frames(path: &Path) -> Result<Vec<Image<f32>>, ReportError> {
    let mut layers = read_exr(path)?;
    layers.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(layers.into_iter().map(|(_, frame)| frame).collect())
}

fn take(layers: &mut Vec<Layer>, name: &str, path: &Path) -> Result<Image<f32>, ReportError> {
    let place = layers.iter().position(|l| l.0 == name);
    let missing = || ReportError::File { path: path.into(), reason: format!("has no layer {name}") };
    place.map(|i| layers.swap_remove(i).1).ok_or_else(missing)
}
