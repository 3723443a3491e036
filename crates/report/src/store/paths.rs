//! Where the files of a run lie.

use std::path::{Path, PathBuf};

/// Where the scorecard of a run lies.
pub(crate) fn scorecard_path(folder: &Path) -> PathBuf {
    folder.join("scorecard.json")
}

/// Files are named by number: names of scenes may hold anything.
pub(super) fn truth_path(folder: &Path, window: usize) -> PathBuf {
    folder.join("pictures").join(format!("window-{window:02}-truth.exr"))
}

pub(super) fn variant_path(folder: &Path, window: usize, variant: usize) -> PathBuf {
    folder.join("pictures").join(format!("window-{window:02}-variant-{variant:02}.exr"))
}

pub(super) fn series_path(folder: &Path, window: usize, variant: usize) -> PathBuf {
    folder.join("pictures").join(format!("window-{window:02}-variant-{variant:02}-frames.exr"))
}

/// What a map of cells has a value for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CellsOf {
    Pixels,
    Tiles,
}

pub(super) fn cells_path(folder: &Path, (window, variant): (usize, usize), of: CellsOf) -> PathBuf {
    let kind = match of {
        CellsOf::Pixels => "cells",
        CellsOf::Tiles => "tiles",
    };
    folder.join("pictures").join(format!("window-{window:02}-variant-{variant:02}-{kind}.exr"))
}

pub(super) fn truth_series_path(folder: &Path, window: usize) -> PathBuf {
    folder.join("pictures").join(format!("window-{window:02}-truth-frames.exr"))
}
