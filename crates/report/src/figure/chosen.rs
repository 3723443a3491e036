//! From what was asked for to the window, the variants and the insets that figures are made of.

use super::FigureRequest;
use super::crops::one_line;
use crate::store::{PictureIndex, read_index, read_window, scorecard_path};
use crate::trace::traces;
use crate::{Calibration, ReportError, Scorecard, WindowPictures};
use std::path::Path;

/// The window and the variants that figures are made of.
pub(super) struct Chosen<'a> {
    pub(super) run: &'a Path,
    pub(super) card: &'a Scorecard,
    pub(super) index: PictureIndex,
    pub(super) window: usize,
    pub(super) pictures: WindowPictures,
    pub(super) variants: Vec<usize>,
    /// Each inside the picture.
    pub(super) crops: Vec<[u32; 4]>,
    pub(super) times: u32,
}

impl<'a> Chosen<'a> {
    /// # Errors
    /// A run that cannot be read, or one that does not have what was asked for.
    pub(super) fn of(
        run: &'a Path,
        card: &'a Scorecard,
        request: &FigureRequest,
    ) -> Result<Self, ReportError> {
        let index = read_index(run)?;
        let window = window(card, &index, request).ok_or_else(|| {
            refusal(run, "no such scene and path with pictures in this run", &windows(card, &index))
        })?;
        let here = |v: &usize| index.variants.iter().any(|s| s.window == window && s.variant == *v);
        let here: Vec<usize> = (0..card.variants.len()).filter(here).collect();
        let variants = variants(card, &here, &request.variants).map_err(|wanted| {
            refusal(run, &format!("no pictures of \"{wanted}\" in that window"), &ids(card, &here))
        })?;
        let pictures = read_window(run, window)?;
        let size = (pictures.truth.width(), pictures.truth.height());
        let crops = match request.crops.as_slice() {
            [] => worst_place(run, card, window, variants.first())?.and_then(|place| inside(place, size)),
            asked => {
                if let Some(&crop) = asked.iter().find(|&&crop| inside(crop, size) != Some(crop)) {
                    return Err(outside(run, crop, size));
                }
                None
            }
        };
        let crops = crops.map_or_else(|| request.crops.clone(), |place| vec![place]);
        let times = request.times.clamp(1, 16);
        Ok(Self { run, card, index, window, pictures, variants, crops, times })
    }
}

fn refusal(run: &Path, reason: &str, there: &[String]) -> ReportError {
    let there = if there.is_empty() { "none".into() } else { there.join(", ") };
    ReportError::Request {
        path: scorecard_path(run),
        reason: one_line(&format!("{reason}; there is: {there}")),
    }
}

fn outside(run: &Path, [x, y, w, h]: [u32; 4], (width, height): (u32, u32)) -> ReportError {
    let reason =
        format!("the crop {x},{y},{w},{h} is not inside the picture: it has {width}x{height} pixels");
    ReportError::Request { path: scorecard_path(run), reason }
}

/// The first window with pictures that has these names.
fn window(card: &Scorecard, index: &PictureIndex, request: &FigureRequest) -> Option<usize> {
    let fits = |wanted: &Option<String>, name: &str| wanted.as_ref().is_none_or(|w| w == name);
    card.windows.iter().enumerate().position(|(i, w)| {
        fits(&request.scene, &w.scene)
            && fits(&request.path, &w.path)
            && index.windows.iter().any(|s| s.0 == i)
    })
}

fn windows(card: &Scorecard, index: &PictureIndex) -> Vec<String> {
    let stored = index.windows.iter().filter_map(|s| card.windows.get(s.0));
    stored.map(|w| format!("{}, {}", w.scene, w.path)).collect()
}

fn id(card: &Scorecard, v: usize) -> String {
    format!("{}/{}", card.variants[v].name, card.variants[v].calibration.id())
}

fn ids(card: &Scorecard, here: &[usize]) -> Vec<String> {
    here.iter().map(|&v| id(card, v)).collect()
}

/// Those asked for, in that order; all whose sizes fit the light otherwise. A name alone is its light-matched
/// variant where there is one. The error is the name that is not there.
fn variants(card: &Scorecard, here: &[usize], asked: &[String]) -> Result<Vec<usize>, String> {
    let printed = |v: &usize| card.variants[*v].calibration == Calibration::AsPrinted;
    if asked.is_empty() {
        let matched: Vec<usize> = here.iter().copied().filter(|v| !printed(v)).collect();
        return Ok(if matched.is_empty() { here.to_vec() } else { matched });
    }
    let one = |wanted: &String| {
        let exact = here.iter().find(|&&v| id(card, v) == *wanted);
        let mut named: Vec<&usize> = here.iter().filter(|v| card.variants[**v].name == *wanted).collect();
        named.sort_by_key(|v| printed(v));
        exact.or(named.first().copied()).copied().ok_or_else(|| wanted.clone())
    };
    asked.iter().map(one).collect()
}

fn worst_place(
    run: &Path,
    card: &Scorecard,
    window: usize,
    first: Option<&usize>,
) -> Result<Option<[u32; 4]>, ReportError> {
    let all = traces(run, card)?;
    let is_it = |v: usize| first.is_none_or(|first| *first == v);
    let worst = all.iter().find(|t| t.window == window && t.metric == "error" && is_it(t.variant));
    Ok(worst.map(|t| t.place))
}

/// The part of a rectangle that is inside a picture.
fn inside([left, top, width, height]: [u32; 4], (columns, rows): (u32, u32)) -> Option<[u32; 4]> {
    let (right, bottom) = (left.saturating_add(width).min(columns), top.saturating_add(height).min(rows));
    (left < right && top < bottom).then(|| [left, top, right - left, bottom - top])
}
