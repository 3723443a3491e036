//! The list of metrics, in display order. `umbrage list metrics` and the report's definitions are
//! made from it; adding a metric is a file and an entry here.

mod cells;
mod explain;
mod looks;
mod regions;

/// How to read a metric.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MetricInfo {
    /// Stable name in files: `smooth_static`.
    pub id: &'static str,
    /// For people.
    pub name: &'static str,
    /// Unit of the value; empty for a pure number.
    pub unit: &'static str,
    /// Legal values.
    pub range: &'static str,
    /// Which way is better.
    pub direction: Direction,
    /// What it is, in a sentence or two.
    pub definition: &'static str,
    /// How it is computed, in plain text.
    pub formula: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    /// What it does not see.
    pub blind_spot: &'static str,
}

/// Which way a metric is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// 0 is perfect.
    LowerIsBetter,
    /// 1 is perfect.
    TargetOne,
    /// Tells what something is like, not how good it is.
    Descriptive,
}

/// Every metric, in display order.
pub static METRICS: &[MetricInfo] = &[
    cells::ERROR,
    cells::MSE,
    cells::BANDING,
    cells::SWIMMING,
    cells::NOISE,
    cells::SMOOTH_STATIC,
    cells::SMOOTH_MOVING,
    cells::STRUCTURED_STATIC,
    cells::STRUCTURED_MOVING,
    regions::LIGHT_LEAK,
    regions::FALSE_SHADOW,
    regions::LIGHT_LEAK_P99,
    regions::FALSE_SHADOW_P99,
    explain::WIDTH_RATIO,
    explain::WIDTH_ANISOTROPY,
    explain::EFFECTIVE_LEVELS,
    explain::PLATEAU_FRACTION,
    explain::VON_NEUMANN,
    explain::LAG1_PIXEL_FROZEN,
    explain::LAG1_POINT_FROZEN,
    explain::LAG1_PIXEL_ANIMATED,
    explain::LAG1_POINT_ANIMATED,
    explain::NOISE_AFTER_BLUR,
    looks::FLIP,
    looks::SSIM,
    regions::P95,
    regions::P99,
    regions::WORST_TILE,
    regions::OUTSIDE_SHARE,
    regions::EDGE_CRAWL,
    regions::REFERENCE_NOISE,
    regions::COVERAGE,
    regions::DISAGREEMENT,
    regions::BASIS_SHARE,
];

/// The metric with this id.
pub fn metric(id: &str) -> Option<&'static MetricInfo> {
    METRICS.iter().find(|m| m.id == id)
}

/// Ids that cite the project's own scoring model.
const UMBRAGE: &str = "Umbrage: analysis of variance at anchored surface points";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Quantity;
    use std::collections::BTreeSet;

    #[test]
    fn ids_are_unique_and_every_field_is_filled() {
        let ids: BTreeSet<_> = METRICS.iter().map(|m| m.id).collect();
        assert_eq!(ids.len(), METRICS.len());
        for m in METRICS {
            let fields = [m.name, m.range, m.definition, m.formula, m.source, m.blind_spot];
            assert!(fields.iter().all(|f| !f.is_empty()), "{}", m.id);
        }
    }

    #[test]
    fn every_pooled_quantity_is_registered() {
        for quantity in Quantity::ALL {
            assert!(metric(quantity.id()).is_some(), "{}", quantity.id());
        }
    }
}
