//! Figures for papers from a stored run: crops with insets, plots, tables, a path as an animation.
//!
//! Deliberately absent: text inside pictures. What a picture shows, left to right, stands in `captions.txt`.

mod crops;
mod motion;
mod plots;
mod tabular;

use crate::error::write_whole;
use crate::store::{read_index, scorecard_path};
use crate::trace::traces;
use crate::{Calibration, ReportError, Scorecard};
use std::path::{Path, PathBuf};

/// What is wanted of a run.
#[derive(Clone, Debug)]
pub struct FigureRequest {
    /// Scene and path of the window; the first window otherwise.
    pub scene: Option<String>,
    /// See `scene`.
    pub path: Option<String>,
    /// `chss-mask` or `chss-mask/as-printed`, in this order; the light-matched ones otherwise.
    pub variants: Vec<String>,
    /// Left, top, width and height of each inset, in pixels; the worst place of the first variant otherwise.
    pub crops: Vec<[u32; 4]>,
    /// How many times whole pictures are magnified.
    pub times: u32,
}

/// The window and the variants that figures are made of.
struct Chosen<'a> {
    run: &'a Path,
    card: &'a Scorecard,
    window: usize,
    variants: Vec<usize>,
    crops: Vec<[u32; 4]>,
    times: u32,
}

/// Writes every figure that the run has the data for, and says which files there are.
///
/// # Errors
/// A run that cannot be read, names that it does not have, or a file that cannot be written.
pub fn write_figures(run: &Path, request: &FigureRequest, out: &Path) -> Result<Vec<PathBuf>, ReportError> {
    let card = Scorecard::load(&scorecard_path(run))?;
    let chosen = choose(run, &card, request)?;
    std::fs::create_dir_all(out).map_err(ReportError::at(out))?;
    let mut written = Vec::new();
    let mut put = |name: &str, bytes: &[u8]| {
        let path = out.join(name);
        write_whole(&path, bytes).map(|()| written.push(path))
    };
    let (mut captions, values) = crops::write(&chosen, (out, &mut put))?;
    for (name, svg) in plots::all(&chosen) {
        put(&name, svg.as_bytes())?;
    }
    put("scores.tex", tabular::latex(&chosen).as_bytes())?;
    put("scores.csv", tabular::csv(&chosen).as_bytes())?;
    captions += &motion::write(&chosen, &mut put)?;
    put("captions.txt", captions.as_bytes())?;
    written.extend(values);
    Ok(written)
}

fn choose<'a>(
    run: &'a Path,
    card: &'a Scorecard,
    request: &FigureRequest,
) -> Result<Chosen<'a>, ReportError> {
    let refuse = |reason: String| ReportError::Scorecard { path: scorecard_path(run), reason };
    let fits = |wanted: &Option<String>, name: &str| wanted.as_ref().is_none_or(|w| w == name);
    let stored = read_index(run)?;
    let window = card.windows.iter().enumerate().position(|(i, w)| {
        fits(&request.scene, &w.scene)
            && fits(&request.path, &w.path)
            && stored.windows.iter().any(|s| s.0 == i)
    });
    let window = window.ok_or_else(|| refuse("no such scene and path with pictures in this run".into()))?;
    let here = |v: &usize| stored.variants.iter().any(|s| s.window == window && s.variant == *v);
    let named = |wanted: &String| {
        let fits = |v: &usize| {
            let of = &card.variants[*v];
            let id = format!("{}/{}", of.name, of.calibration.id());
            *wanted == id || (*wanted == of.name && of.calibration != Calibration::AsPrinted)
        };
        let found = (0..card.variants.len()).filter(here).find(fits);
        found.ok_or_else(|| refuse(format!("no pictures of \"{wanted}\" in that window")))
    };
    let matched = |v: &usize| card.variants[*v].calibration != Calibration::AsPrinted;
    let variants = match request.variants.as_slice() {
        [] => (0..card.variants.len()).filter(here).filter(matched).collect(),
        wanted => wanted.iter().map(named).collect::<Result<Vec<_>, _>>()?,
    };
    let mut crops = request.crops.clone();
    if crops.is_empty() {
        let all = traces(run, card)?;
        let worst = all.iter().find(|t| {
            t.window == window && t.metric == "error" && variants.first().is_none_or(|v| *v == t.variant)
        });
        crops.extend(worst.map(|t| t.place));
    }
    Ok(Chosen { run, card, window, variants, crops, times: request.times.clamp(1, 16) })
}
