//! What variants cost on a real GPU: measured into a file that is committed, and read back from it.

use super::place::Place;
use super::registry::TimeRow;
use super::subject::{full_name, variant_of};
use crate::error::CliError;
use crate::run::cost::{CostOf, measure_cost, quantile};
use crate::views::{past_of, view_of};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use umbrage_metrics::{Bootstrap, Score, compare_medians};
use umbrage_report::{CostOrigin, DocumentTime};
use umbrage_shadows::{Gpu, Renderer};

/// Times of variants, and where they come from; empty without a GPU.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct CostBook {
    origin: Option<CostOrigin>,
    entries: Vec<CostEntry>,
}

/// One variant in one place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct CostEntry {
    /// As places are labelled.
    place: String,
    variant: String,
    /// Median milliseconds of each pass of a frame.
    passes: Vec<(String, f64)>,
    /// Milliseconds of passes whose results a static light keeps, each timed once.
    kept: Vec<(String, f64)>,
    /// Milliseconds of each repeated frame.
    frames: Vec<f64>,
    /// The same, pass by pass.
    frame_passes: Vec<Vec<f64>>,
}

/// The map itself is every technique's own; its filters are not.
const MAP: &str = "shadow-map";

impl CostBook {
    /// Where the times come from.
    pub(crate) fn origin(&self) -> Option<&CostOrigin> {
        self.origin.as_ref()
    }

    /// Repeats of each frame.
    pub(crate) fn repeats(&self) -> u32 {
        self.entries.first().map_or(0, |e| e.frames.len() as u32)
    }

    /// Reads a committed file; an empty book where there is none.
    pub(crate) fn read(path: &Path) -> Result<Self, CliError> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let text = std::fs::read_to_string(path).map_err(CliError::file(path))?;
        serde_json::from_str(&text).map_err(|e| CliError::Suite { path: path.into(), message: e.to_string() })
    }

    /// Writes it for the repository.
    pub(crate) fn write(&self, path: &Path) -> Result<(), CliError> {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(CliError::file(folder))?;
        }
        let text = serde_json::to_string(self)
            .map_err(|e| CliError::Suite { path: path.into(), message: e.to_string() })?;
        std::fs::write(path, text.replace("},{", "},\n{") + "\n").map_err(CliError::file(path))
    }

    fn entry(&self, place: &str, variant: &str) -> Option<&CostEntry> {
        self.entries.iter().find(|e| e.place == place && e.variant == variant)
    }

    /// Milliseconds of each repeat.
    pub(crate) fn sample(&self, place: &Place, variant: &str, number: &str) -> Option<Vec<f64>> {
        let entry = self.entry(&place.label(), variant)?;
        let filters: f64 =
            entry.kept.iter().filter(|(label, _)| !label.starts_with(MAP)).map(|(_, ms)| ms).sum();
        let more = if number == "cost_with_maps" { filters } else { 0.0 };
        Some(entry.frames.iter().map(|ms| ms + more).collect())
    }

    /// A document's table beside ours, as ratios to its first row.
    pub(crate) fn table(&self, rows: &[TimeRow], bootstrap: &Bootstrap) -> Vec<DocumentTime> {
        let Some(base) = rows.first() else { return vec![] };
        let place = self.entries.first().map(|e| e.place.clone()).unwrap_or_default();
        let sample = |row: &TimeRow| -> Option<Vec<f64>> {
            let entry = self.entry(&place, &full_name(&row.ours))?;
            let counts = |label: &str| {
                row.passes.as_deref().is_none_or(|p| label.starts_with(p))
                    && row.without.as_deref().is_none_or(|p| !label.starts_with(p))
            };
            let sum = |ms: &Vec<f64>| {
                entry.passes.iter().zip(ms).filter(|((label, _), _)| counts(label)).map(|(_, ms)| ms).sum()
            };
            Some(entry.frame_passes.iter().map(sum).collect())
        };
        let ratio = |row: &TimeRow| -> Option<Score> {
            let samples = [sample(row)?, sample(base)?];
            compare_medians(&[&samples[0], &samples[1]], |m| vec![m[0] / m[1]], bootstrap).ok().map(|s| s[0])
        };
        let card = |row: &TimeRow| DocumentTime {
            what: row.what.clone(),
            document_ms: row.document_ms,
            document_ratio: row.document_ms / base.document_ms,
            ours: match (&row.passes, &row.without) {
                (Some(passes), _) => format!("{}, passes {passes}*", row.ours),
                (None, Some(without)) => format!("{} without {without}*", row.ours),
                (None, None) => row.ours.clone(),
            },
            ratio: ratio(row),
        };
        rows.iter().map(card).collect()
    }
}

/// Times everything on the middle frame of its place's path.
pub(crate) fn measure_costs(
    needs: &BTreeMap<Place, BTreeSet<String>>,
    (gpu, map_texels): (&mut Gpu, u32),
    origin: CostOrigin,
) -> Result<CostBook, CliError> {
    let size = (origin.width, origin.height);
    let mut book = CostBook { origin: Some(origin), entries: vec![] };
    for (place, names) in needs {
        let scene = place.build()?;
        let path = scene.path(&place.path)?;
        let middle = path.frames.len() / 2;
        let frame = path.frames[middle];
        let view = view_of(&frame, size);
        let variants: Vec<_> = names.iter().filter_map(|name| variant_of(name)).collect();
        let mut renderer = Renderer::new(gpu, &scene, place.map.unwrap_or(map_texels))?;
        renderer.set_past(past_of(path, middle as u32, size));
        let costs = measure_cost(&mut renderer, (&view, &frame.light), &variants)?;
        book.entries.extend(costs.iter().map(|cost| entry(place, cost)));
    }
    Ok(book)
}

fn entry(place: &Place, cost: &CostOf) -> CostEntry {
    let median = |pass: usize| quantile(cost.frames.iter().map(|f| f[pass]).collect(), 0.5);
    let passes = cost.passes.iter().enumerate().map(|(i, label)| ((*label).to_string(), median(i)));
    CostEntry {
        place: place.label(),
        variant: cost.variant.clone(),
        passes: if cost.frames.is_empty() { vec![] } else { passes.collect() },
        kept: cost.kept.iter().map(|(label, ms)| ((*label).to_string(), *ms)).collect(),
        frames: cost.frames.iter().map(|f| f.iter().sum()).collect(),
        frame_passes: cost.frames.clone(),
    }
}
