//! Where a number comes from: the place and the frame that add most to it.

use crate::gate::{Baseline, BaselineSums, gated};
use crate::{ReportError, Scorecard};
use serde::Serialize;
use std::path::Path;
use umbrage_metrics::{PooledNumber, SumTable, gate_table};

/// The worst place of a score of a variant in a window.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Trace {
    pub(crate) window: usize,
    pub(crate) variant: usize,
    pub(crate) metric: &'static str,
    /// Left, top, width and height in pixels of the middle frame.
    pub(crate) place: [u32; 4],
    /// Index on the path of the frame that adds most to the motion; none for what does not move.
    frame: Option<u32>,
}

/// From the sums beside a scorecard; nothing where a run has none.
pub(crate) fn traces(run: &Path, card: &Scorecard) -> Result<Vec<Trace>, ReportError> {
    let path = run.join("sums.json");
    if !path.exists() {
        return Ok(Vec::new());
    }
    let sums = Baseline::load(&path)?;
    Ok(sums.sums.iter().flat_map(|of| of_variant(card, &sums, of)).collect())
}

fn of_variant(card: &Scorecard, sums: &Baseline, of: &BaselineSums) -> Vec<Trace> {
    let place = &sums.windows[of.window];
    let same = |w: &crate::WindowCard| {
        (&w.scene, &w.path, w.first_frame) == (&place.scene, &place.path, place.first_frame)
    };
    let name = |v: &crate::VariantCard| format!("{}/{}", v.name, v.calibration.id());
    let window = card.windows.iter().position(same);
    let variant = card.variants.iter().position(|v| name(v) == sums.variants[of.variant]);
    let (Some(window), Some(variant)) = (window, variant) else { return Vec::new() };
    let tables = [&of.cells, &of.profile, &of.blocks].map(|rows| BaselineSums::table(rows, place));
    let worst_frame = of.per_frame.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    let frame = worst_frame.filter(|f| *f.1 > 0.0).map(|f| place.first_frame + f.0 as u32 * place.step);
    // A cluster is 2x2 tiles.
    let side = 2 * card.provenance.tile_px;
    let trace = |(metric, number): (&'static str, PooledNumber)| {
        let [column, row] = worst(&tables[gate_table(number)], number)?;
        // A picture's last tiles may be cut.
        let (left, top) = (column * side, row * side);
        let room = |from: u32, whole: u32| side.min(whole.saturating_sub(from));
        let place = [left, top, room(left, card.provenance.width), room(top, card.provenance.height)];
        let moves = ["swimming", "smooth_moving", "structured_moving"].contains(&metric);
        Some(Trace { window, variant, metric, place, frame: frame.filter(|_| moves) })
    };
    gated().filter_map(trace).collect()
}

/// The cluster without which the number would be furthest down.
fn worst(table: &SumTable, number: PooledNumber) -> Option<[u32; 2]> {
    let without = |skip: usize| {
        let kept = table.rows.iter().enumerate().filter(|(i, _)| *i != skip);
        let value = number.of(&[&SumTable { rows: kept.map(|(_, row)| row.clone()).collect() }])?;
        // A width is wrong on either side of 1.
        Some(if number == PooledNumber::WidthRatio { (value - 1.0).abs() } else { value })
    };
    let places = table.rows.iter().enumerate().filter_map(|(i, &(c, r, _))| Some((without(i)?, [c, r])));
    places.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
}
