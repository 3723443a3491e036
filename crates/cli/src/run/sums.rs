//! What a later run is compared with: the sums of this one.

use super::Scored;
use umbrage_metrics::{Bootstrap, SumTable};
use umbrage_report::{BASELINE_VERSION, Baseline, BaselineSums, BaselineWindow, Margins, Provenance};

/// The sums of every window that was scored.
pub(super) fn of(
    (variants, margins): (Vec<String>, Margins),
    provenance: &Provenance,
    scored: &[Scored],
) -> Baseline {
    let mut baseline = Baseline {
        baseline_version: BASELINE_VERSION,
        checksum: String::new(),
        provenance: provenance.clone(),
        margins,
        variants,
        windows: Vec::new(),
        sums: Vec::new(),
    };
    let side = Bootstrap::default().cluster_tiles;
    for entry in scored.iter().filter(|s| !s.variants.is_empty() && s.window.coverage.counted > 0) {
        let window = baseline.windows.len();
        let mut clusters = Vec::new();
        for (variant, measured) in entry.variants.iter().enumerate() {
            let numbers = &measured.numbers;
            let rows = |table: SumTable| table.clustered(side).rows;
            let cells = rows(numbers.anchored.sum_table());
            clusters = cells.iter().map(|&(column, row, _)| [column, row]).collect();
            let sums = |rows: Vec<(u32, u32, Vec<f64>)>| rows.into_iter().map(|(.., sums)| sums).collect();
            baseline.sums.push(BaselineSums {
                window,
                variant,
                cells: sums(cells),
                profile: sums(rows(numbers.profile.clone())),
                blocks: sums(rows(numbers.blocks.clone())),
                spread: numbers
                    .spread
                    .iter()
                    .flatten()
                    .map(|spread| spread.map(|s| [s.variance, s.freedom]))
                    .collect(),
                per_frame: per_frame(&numbers.anchored.tiles),
            });
        }
        let facts = &entry.window;
        baseline.windows.push(BaselineWindow {
            scene: facts.scene.clone(),
            path: facts.path.clone(),
            first_frame: facts.first,
            frames: facts.frames,
            step: facts.step,
            views: facts.views.clone(),
            clusters,
        });
    }
    baseline
}

/// What each frame adds to the motion, over all tiles.
fn per_frame(tiles: &[umbrage_metrics::TileRow]) -> Vec<f64> {
    let frames = tiles.iter().map(|t| t.swimming.len()).max().unwrap_or(0);
    (0..frames).map(|f| tiles.iter().filter_map(|t| t.swimming.get(f)).sum()).collect()
}
