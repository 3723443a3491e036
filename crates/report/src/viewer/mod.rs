//! What the viewer of the page reads: planes of half floats, and a description of them.
//!
//! In a single file the planes are blocks of text that no browser runs; beside a page they are
//! scripts that hand their text over, because a page opened from a disk may not fetch files.

mod cells;
mod data;
mod encode;

pub(crate) use data::{describe, inert};

use crate::error::write_whole;
use crate::store::{
    CellsOf, PictureIndex, StoredVariant, read_cells, read_series, read_truth_series, read_variant,
    read_window,
};
use crate::{Calibration, Layout, ReportError, Scorecard};
use cells::{Peaks, roots};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use umbrage_frame::Image;

/// The planes of a run, by key: `w0-truth`, `w0-v3-shadow`, `w0-v3-series`.
#[derive(Debug, Default)]
pub(crate) struct Planes {
    /// Frames of each plane.
    pub(crate) frames: BTreeMap<String, usize>,
    /// Their text, where it goes into the page.
    pub(crate) inline: Vec<(String, String)>,
    /// The folder beside the page, where it does not.
    pub(crate) beside: Option<&'static str>,
    /// Columns and rows of each window's planes.
    pub(crate) sizes: BTreeMap<usize, (u32, u32)>,
    /// World to clip space, frame by frame, of windows that have it.
    pub(crate) cameras: BTreeMap<usize, Vec<[f32; 16]>>,
    /// Where the colours of each map of cells end, by window.
    pub(crate) cell_limits: BTreeMap<usize, BTreeMap<&'static str, f32>>,
}

/// Where the planes go.
struct Packer<'a> {
    planes: Planes,
    folder: Option<PathBuf>,
    card: &'a Scorecard,
    peaks: Peaks,
}

/// Packs every plane of a run, one picture at a time.
pub(crate) fn pack(
    run: &Path,
    card: &Scorecard,
    index: &PictureIndex,
    (layout, beside): (Layout, &'static str),
) -> Result<Planes, ReportError> {
    let planes = Planes { cameras: index.cameras.clone(), ..Planes::default() };
    let mut packer = Packer { planes, folder: None, card, peaks: Peaks::default() };
    if layout == Layout::Folder {
        let folder = run.join(beside);
        std::fs::create_dir_all(&folder).map_err(ReportError::at(&folder))?;
        (packer.folder, packer.planes.beside) = (Some(folder), Some(beside));
    }
    for &(window, _) in index.windows.iter().filter(|w| w.0 < card.windows.len()) {
        packer.window(run, window, index.truth_series.contains(&window))?;
    }
    let known = |v: &&StoredVariant| v.window < card.windows.len() && v.variant < card.variants.len();
    for stored in index.variants.iter().filter(known) {
        packer.variant(run, stored)?;
    }
    Ok(Planes { cell_limits: packer.peaks.limits(), ..packer.planes })
}

/// Frames in a single file are rounded to steps of 1/512, half of what a screen of 8 bits shows: noise
/// in all its bits does not compress.
fn coarse(value: f32) -> f32 {
    (value * 512.0).round() / 512.0
}

impl Packer<'_> {
    fn window(&mut self, run: &Path, window: usize, series: bool) -> Result<(), ReportError> {
        let pictures = read_window(run, window)?;
        self.planes.sizes.insert(window, (pictures.truth.width(), pictures.truth.height()));
        self.put(format!("w{window}-truth"), &[&pictures.truth])?;
        if let Some(surface) = &pictures.surface {
            let of = [("depth", &surface.depth), ("region", &surface.region), ("se", &surface.truth_error)];
            for (name, plane) in of {
                self.put(format!("w{window}-{name}"), &[plane])?;
            }
            if let Some(width) = &surface.width {
                self.put(format!("w{window}-width"), &[width])?;
            }
        }
        if series {
            let frames = read_truth_series(run, window)?;
            self.put(format!("w{window}-truth-series"), &frames.iter().collect::<Vec<_>>())?;
        }
        Ok(())
    }

    /// The error is not packed: it is shadow less truth, and would not compress.
    fn variant(&mut self, run: &Path, stored: &StoredVariant) -> Result<(), ReportError> {
        let &StoredVariant { window, variant, frames, .. } = stored;
        let pictures = read_variant(run, window, variant)?;
        self.put(format!("w{window}-v{variant}-shadow"), &[&pictures.mask])?;
        if let Some(swim) = &pictures.swim {
            self.put(format!("w{window}-v{variant}-swim"), &[swim])?;
        }
        self.cells(run, stored)?;
        // One file holds the comparison's frames; those of the curiosity are large too.
        let matched = self.card.variants[variant].calibration != Calibration::AsPrinted;
        if frames > 0 && (matched || self.folder.is_some()) {
            let mut frames = read_series(run, window, variant)?;
            if self.folder.is_none() {
                frames.iter_mut().for_each(|frame| *frame = frame.map(|&v| coarse(v)));
            }
            self.put(format!("w{window}-v{variant}-series"), &frames.iter().collect::<Vec<_>>())?;
        }
        Ok(())
    }

    /// By tile everywhere; by pixel only beside a page, for five planes a variant are large.
    fn cells(&mut self, run: &Path, stored: &StoredVariant) -> Result<(), ReportError> {
        let &StoredVariant { window, variant, cells: [pixels, tiles], .. } = stored;
        let by_pixel = pixels && self.folder.is_some();
        for (of, name, packed) in [(CellsOf::Tiles, "tiles", tiles), (CellsOf::Pixels, "cells", by_pixel)] {
            if !packed {
                continue;
            }
            let maps = read_cells(run, (window, variant), of)?;
            if of == CellsOf::Pixels || !by_pixel {
                self.peaks.add(window, &maps);
            }
            self.put(format!("w{window}-v{variant}-{name}"), &roots(&maps).iter().collect::<Vec<_>>())?;
        }
        Ok(())
    }

    fn put(&mut self, key: String, frames: &[&Image<f32>]) -> Result<(), ReportError> {
        let broken = |e: std::io::Error| ReportError::Picture { name: key.clone(), reason: e.to_string() };
        let text = encode::text(frames).map_err(broken)?;
        self.planes.frames.insert(key.clone(), frames.len());
        match &self.folder {
            None => self.planes.inline.push((key, text)),
            Some(folder) => {
                let script = format!("umbragePlane(\"{key}\",\"{text}\");\n");
                write_whole(&folder.join(format!("{key}.js")), script.as_bytes())?;
            }
        }
        Ok(())
    }
}
