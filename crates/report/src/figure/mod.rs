//! Figures for papers from a stored run: crops with insets, plots, tables, a path as an animation.
//!
//! Deliberately absent: text inside pictures. What a picture shows, left to right, stands in `captions.txt`.

mod chosen;
mod crops;
mod motion;
mod paint;
mod pdf;
mod plots;
mod points;
mod tabular;
mod tex;

use crate::error::write_whole;
use crate::store::scorecard_path;
use crate::{ReportError, Scorecard};
use chosen::Chosen;
use std::path::{Path, PathBuf};

/// What is wanted of a run.
#[derive(Clone, Debug)]
pub struct FigureRequest {
    /// Scene and path of the window; the first window otherwise.
    pub scene: Option<String>,
    /// See `scene`.
    pub path: Option<String>,
    /// `chss-mask` or `chss-mask/as-printed`, in this order; all but those as printed otherwise.
    pub variants: Vec<String>,
    /// Left, top, width and height of each inset, in pixels, inside the picture; the worst place of the first variant
    /// otherwise.
    pub crops: Vec<[u32; 4]>,
    /// How many times whole pictures are magnified.
    pub times: u32,
}

/// Writes every figure that the run has the data for, and says which files there are.
///
/// # Errors
/// A run that cannot be read, [`ReportError::Request`] for names and places that it does not have, or a file that
/// cannot be written.
pub fn write_figures(run: &Path, request: &FigureRequest, out: &Path) -> Result<Vec<PathBuf>, ReportError> {
    let card = Scorecard::load(&scorecard_path(run))?;
    let chosen = Chosen::of(run, &card, request)?;
    std::fs::create_dir_all(out).map_err(ReportError::at(out))?;
    let mut written = Vec::new();
    let mut put = |name: &str, bytes: &[u8]| {
        let path = out.join(name);
        write_whole(&path, bytes).map(|()| written.push(path))
    };
    let (mut captions, values) = crops::write(&chosen, (out, &mut put))?;
    plots::write(&chosen, &mut put)?;
    put("scores.tex", tabular::latex(&chosen).as_bytes())?;
    put("scores.csv", tabular::csv(&chosen).as_bytes())?;
    captions += &motion::write(&chosen, &mut put)?;
    put("captions.txt", captions.as_bytes())?;
    written.extend(values);
    Ok(written)
}
