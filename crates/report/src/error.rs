//! What can go wrong between a run and its pages.

use std::path::{Path, PathBuf};

/// Why a run could not be stored, read or shown.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The system refused a file or a folder: missing, read-only, disk full.
    #[error("{}: {reason}", path.display())]
    File {
        /// Which file or folder.
        path: PathBuf,
        /// The system's reason.
        reason: String,
    },
    /// A plane could not be stored or read back.
    #[error(transparent)]
    Exr(#[from] umbrage_frame::ExrError),
    /// The file is not a scorecard, or not one of this version.
    #[error("{}: {reason}", path.display())]
    Scorecard {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it, and what to do.
        reason: String,
    },
    /// Something was asked of a run that it does not have.
    #[error("{}: {reason}", path.display())]
    Request {
        /// The run's scorecard.
        path: PathBuf,
        /// What it does not have, and what it has.
        reason: String,
    },
    /// The file is not a baseline, not one of this version, or edited by hand.
    #[error("{}: {reason}", path.display())]
    Baseline {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it, and what to do.
        reason: String,
    },
    /// Two runs that differ in what they measured.
    #[error("the runs do not compare:\n  {}", .0.join("\n  "))]
    NotComparable(
        /// Every reason.
        Vec<String>,
    ),
    /// A number that is NaN or infinite: JSON has no word for it and nobody could read it back.
    #[error("{place}: {metric} is not a finite number; nothing was written")]
    NotFinite {
        /// Scene, path and variant.
        place: String,
        /// The metric's id.
        metric: String,
    },
    /// A card points at a window, variant or metric that does not exist, or twice at the same.
    #[error("the scorecard contradicts itself: {0}")]
    Contradiction(String),
    /// A picture could not be compressed.
    #[error("picture {name}: {reason}")]
    Picture {
        /// Which picture.
        name: String,
        /// The encoder's reason.
        reason: String,
    },
}

impl ReportError {
    /// For `map_err`: attaches the path to a system's error.
    pub(crate) fn at(path: &Path) -> impl FnOnce(std::io::Error) -> Self + '_ {
        move |e| Self::File { path: path.into(), reason: e.to_string() }
    }
}

/// Writes to a temporary name and renames it, so that a reader never meets half a file.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    let mut name = path.file_name().unwrap_or_default().to_os_string();
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(name);
    let written = std::fs::write(&temporary, bytes).and_then(|()| std::fs::rename(&temporary, path));
    if written.is_err() {
        // The reason for the failure matters more than what is left of it.
        let _ = std::fs::remove_file(&temporary);
    }
    written.map_err(ReportError::at(path))
}
