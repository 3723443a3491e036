//! What ends a run, with its exit code and its cure.

use std::path::PathBuf;
use umbrage_metrics::MetricsError;
use umbrage_reference::ReferenceError;
use umbrage_report::ReportError;
use umbrage_scene::SceneError;
use umbrage_shadows::{DeviceError, ShadowError};

#[derive(Debug, thiserror::Error)]
pub(crate) enum CliError {
    #[error("{0}")]
    Usage(String),
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    #[error(transparent)]
    Shadow(#[from] ShadowError),
    #[error(transparent)]
    Metrics(#[from] MetricsError),
    #[error(transparent)]
    Report(#[from] ReportError),
    #[error(transparent)]
    Exr(#[from] umbrage_frame::ExrError),
    #[error("{}: {source}", path.display())]
    File { path: PathBuf, source: std::io::Error },
    #[error("{}: {message}", path.display())]
    Suite { path: PathBuf, message: String },
    #[error("{}: {message}", path.display())]
    Frame { path: PathBuf, message: String },
    #[error(transparent)]
    Sequence(#[from] umbrage_frame::SequenceError),
    #[error("the frames do not fit the scene, light and cameras: {0}")]
    Projection(String),
    #[error("nothing could be scored: {0}")]
    NothingScored(String),
    #[error("not a finite number: {0}")]
    NotFinite(String),
    #[error("no baseline \"{name}\" for this adapter: there is no {}", path.display())]
    NoBaseline { name: String, path: PathBuf },
    #[error("{0}")]
    Regressed(String),
    #[error("interrupted")]
    Interrupted { cache: PathBuf },
}

impl CliError {
    /// The exit codes that the help lists.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Usage(_)
            | Self::Reference(ReferenceError::Device(DeviceError::UnknownBackend { .. }))
            | Self::Scene(SceneError::UnknownName { .. })
            | Self::Report(ReportError::Request { .. })
            | Self::Shadow(
                ShadowError::Device(DeviceError::UnknownBackend { .. })
                | ShadowError::WrongLight { .. }
                | ShadowError::Setting { .. },
            ) => 2,
            Self::Regressed(_) => 1,
            Self::NothingScored(_) | Self::Projection(_) | Self::Report(ReportError::NotComparable(_)) => 3,
            Self::NoBaseline { .. } => 5,
            Self::Interrupted { .. } => 130,
            _ => 4,
        }
    }

    /// What to do about it, where the message does not say so itself.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Interrupted { cache } => Some(format!(
                "finished truth and results are kept in {}; the same command takes up there",
                cache.display()
            )),
            Self::Scene(SceneError::UnknownName { kind: "scene", .. }) => {
                Some("`umbrage list scenes` shows the standard ones; a file or folder works too".into())
            }
            Self::NoBaseline { name, .. } => Some(format!(
                "the same command with `--save-baseline {name}` makes one; baselines of other adapters do not count"
            )),
            Self::Reference(ReferenceError::Device(_)) => {
                Some("`--reference-on cpu` finds the same truth without a GPU".into())
            }
            Self::Report(ReportError::NotComparable(_)) => Some(
                "run with the baseline's settings, or make it again with `--save-baseline` if the change was meant"
                    .into(),
            ),
            Self::NothingScored(_) => {
                Some("look at the pictures of the report; check the camera path and the light".into())
            }
            _ => None,
        }
    }

    /// Names the file that the system's error is about.
    pub(crate) fn file(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Self::File { path, source }
    }
}
