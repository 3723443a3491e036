//! What a variant costs on a real adapter: timestamp queries round each pass.

use crate::error::CliError;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};
use umbrage_frame::View;
use umbrage_report::{Cost, PassCost};
use umbrage_scene::AreaLight;
use umbrage_shadows::{Renderer, Seeding, Timing, VariantId};

/// Times of one variant in one window.
pub(crate) struct CostOf {
    pub(crate) variant: String,
    /// Milliseconds of each repeated frame, in the order of `passes`.
    pub(crate) frames: Vec<Vec<f64>>,
    pub(crate) passes: Vec<&'static str>,
    /// Passes whose results are kept over frames, each timed once.
    pub(crate) kept: Vec<(&'static str, f64)>,
}

const WARM_UP: usize = 10;
const REPEATS: usize = 60;

/// Scoring leaves a GPU idle for seconds, and an idle one runs at a fraction of its clock: measured
/// on an H200, the same pass took 1.7 times as long right after.
const WAKE_UP: Duration = Duration::from_secs(1);

/// The camera's depth is every renderer's own: it is no part of a shadow's cost.
const NOT_OURS: &str = "depth-prepass";

/// Whether a pass is a cost of this frame's shadow. What a history makes again was the cost of the
/// frames before.
fn is_ours(timing: &Timing) -> bool {
    timing.label != NOT_OURS && !timing.earlier
}

/// Times every variant on one frame, whose past the renderer has been told. Passes whose results are kept are timed when they run
/// for the first time in a scene.
pub(crate) fn measure_cost(
    renderer: &mut Renderer<'_>,
    (view, light): (&View, &AreaLight),
    variants: &[VariantId],
) -> Result<Vec<CostOf>, CliError> {
    let pattern = (Seeding::Frozen, [0, 0]);
    let started = Instant::now();
    while started.elapsed() < WAKE_UP {
        for &variant in variants {
            renderer.time_frame(variant, (view, light), pattern)?;
        }
    }
    let mut costs = Vec::new();
    for &variant in variants {
        renderer.forget();
        let mut cost = CostOf { variant: variant.name(), frames: vec![], passes: vec![], kept: vec![] };
        for repeat in 0..WARM_UP + REPEATS {
            let timings = renderer.time_frame(variant, (view, light), pattern)?;
            let (kept, ours): (Vec<_>, Vec<_>) = timings.iter().filter(|t| is_ours(t)).partition(|t| t.kept);
            cost.kept.extend(kept.iter().map(|t| (t.label, t.ms)));
            if repeat >= WARM_UP && !ours.is_empty() {
                cost.passes = ours.iter().map(|t| t.label).collect();
                cost.frames.push(ours.iter().map(|t| t.ms).collect());
            }
        }
        costs.push(cost);
    }
    Ok(costs)
}

/// The costs of one variant over all windows, as a scorecard has them.
pub(super) fn pooled(costs: &[CostOf], variant: VariantId, adapter: &str) -> Option<Cost> {
    let name = variant.name();
    let ours: Vec<&CostOf> = costs.iter().filter(|c| c.variant == name && !c.frames.is_empty()).collect();
    let first = ours.first()?;
    let totals: Vec<f64> = ours.iter().flat_map(|c| &c.frames).map(|passes| passes.iter().sum()).collect();
    let mut by_pass: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for (pass, &ms) in ours.iter().flat_map(|c| &c.frames).flat_map(|passes| passes.iter().enumerate()) {
        by_pass.entry(pass).or_default().push(ms);
    }
    let passes = first.passes.iter().zip(by_pass.into_values());
    let kept: Vec<f64> = ours.iter().map(|c| c.kept.iter().map(|(_, ms)| ms).sum()).collect();
    Some(Cost {
        adapter: adapter.to_string(),
        frame_ms_median: quantile(totals.clone(), 0.5),
        frame_ms_p95: quantile(totals, 0.95),
        passes: passes
            .map(|(label, ms)| PassCost { name: (*label).to_string(), median_ms: quantile(ms, 0.5) })
            .collect(),
        once_per_scene_ms: Some(quantile(kept, 0.5)),
    })
}

pub(crate) fn quantile(mut values: Vec<f64>, fraction: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * fraction).round() as usize]
}
