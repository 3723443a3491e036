//! Percentiles over points, and the worst tile: a hot spot hides in a mean.
//!
//! Source: METRICS sections 2 and 6. Range: 0 to 1 (visibility). Direction: lower is better. Blind
//! spot: a point's error holds its reference noise; a maximum grows with the number of tiles.

use crate::cells::check_alike;
use crate::{Bootstrap, Measurement, MetricsError, Missing, PointMaps, TileTable, Tiling};
use std::collections::BTreeMap;

/// Of which points, and of what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tail {
    /// Root of the mean squared error of penumbra points.
    Error,
    /// Mean visibility of umbra points.
    LightLeak,
    /// Mean darkness of lit points.
    FalseShadow,
}

/// The values of one window, largest first, each with its tile.
#[derive(Clone, Debug, PartialEq)]
pub struct TailTable {
    /// Column and row of each tile.
    tiles: Vec<(u32, u32)>,
    /// For each kind of tail, (value, index of its tile).
    sorted: [Vec<(f32, u32)>; 3],
}

/// Sorts a window's points by how wrong they are.
pub fn window_tails(maps: &PointMaps, tiling: &Tiling) -> TailTable {
    let sorted = [Tail::Error, Tail::LightLeak, Tail::FalseShadow].map(|tail| {
        let mut values = Vec::new();
        for (index, tile) in tiling.tiles.iter().enumerate() {
            let points = match tail {
                Tail::Error => &tile.penumbra,
                Tail::LightLeak => &tile.umbra,
                Tail::FalseShadow => &tile.lit,
            };
            values.extend(points.iter().map(|&p| (tail.value(maps, p as usize), index as u32)));
        }
        values.sort_by(|a: &(f32, u32), b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        values
    });
    TailTable { tiles: tiling.tiles.iter().map(|t| (t.column, t.row)).collect(), sorted }
}

impl Tail {
    fn value(self, maps: &PointMaps, point: usize) -> f32 {
        match self {
            Self::Error => maps.squared_error[point].max(0.0).sqrt(),
            Self::LightLeak => maps.mean[point],
            Self::FalseShadow => 1.0 - maps.mean[point],
        }
    }

    fn missing(self) -> Missing {
        match self {
            Self::Error => Missing::NoPenumbra,
            Self::LightLeak => Missing::NoUmbra,
            Self::FalseShadow => Missing::NoLit,
        }
    }
}

/// The value that a share `fraction` of the points stays below (0.95, 0.99): the mean over windows
/// of each window's percentile, with an interval over tiles.
pub fn percentile(tables: &[&TailTable], tail: Tail, fraction: f64, bootstrap: &Bootstrap) -> Measurement {
    let windows: Vec<Window> = tables
        .iter()
        .map(|table| Window::new(table, tail, bootstrap.cluster_tiles))
        .filter(|window| !window.sizes.is_empty())
        .collect();
    if windows.is_empty() {
        return Measurement::NotMeasured(tail.missing());
    }
    let clusters: Vec<usize> = windows.iter().map(|w| w.sizes.len()).collect();
    let mean = |weights: &[Vec<u32>]| {
        let sum: f64 = windows.iter().zip(weights).map(|(w, weights)| w.percentile(weights, fraction)).sum();
        vec![sum / windows.len() as f64]
    };
    Measurement::Measured(bootstrap.estimate_weighted(&clusters, mean)[0].score)
}

/// A window's values with the cluster of each.
struct Window<'a> {
    values: &'a [(f32, u32)],
    /// Cluster of each tile.
    cluster: Vec<u32>,
    /// Number of values in each cluster.
    sizes: Vec<u64>,
}

impl<'a> Window<'a> {
    fn new(table: &'a TailTable, tail: Tail, cluster_tiles: u32) -> Self {
        let side = cluster_tiles.max(1);
        let values = &table.sorted[tail as usize];
        let mut counts = vec![0u64; table.tiles.len()];
        values.iter().for_each(|&(_, tile)| counts[tile as usize] += 1);
        let mut index: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut sizes = Vec::new();
        let mut cluster = vec![0; table.tiles.len()];
        for (tile, &(column, row)) in table.tiles.iter().enumerate().filter(|&(tile, _)| counts[tile] > 0) {
            let next = sizes.len() as u32;
            cluster[tile] = *index.entry((row / side, column / side)).or_insert(next);
            sizes.resize(index.len(), 0);
            sizes[cluster[tile] as usize] += counts[tile];
        }
        Self { values, cluster, sizes }
    }

    /// Walks down from the largest value until the share above is used up.
    fn percentile(&self, weights: &[u32], fraction: f64) -> f64 {
        let total: u64 = self.sizes.iter().zip(weights).map(|(size, &w)| size * u64::from(w)).sum();
        let above = (total as f64 * (1.0 - fraction)).floor() as u64;
        let mut seen = 0;
        for &(value, tile) in self.values {
            seen += u64::from(weights[self.cluster[tile as usize] as usize]);
            if seen > above {
                return f64::from(value);
            }
        }
        f64::NAN
    }
}

/// Fewest penumbra points of a tile that can be the worst: below, one silhouette pixel would win.
pub const WORST_TILE_POINTS: u32 = 32;

/// A tile of a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstTile {
    /// Which window.
    pub window: usize,
    /// Column, in tiles.
    pub column: u32,
    /// Row, in tiles.
    pub row: u32,
    /// Its penumbra points.
    pub points: u32,
    /// Root of its mean squared error.
    pub error: f64,
}

/// The tile with the largest ERROR, for a crop; `None` where no tile has enough penumbra.
///
/// # Errors
/// No window, or windows of different kinds.
pub fn worst_tile(tables: &[&TileTable]) -> Result<Option<WorstTile>, MetricsError> {
    check_alike(tables)?;
    let tiles = tables.iter().enumerate().flat_map(|(window, table)| {
        table.tiles.iter().filter(|t| t.points >= WORST_TILE_POINTS).map(move |t| WorstTile {
            window,
            column: t.column,
            row: t.row,
            points: t.points,
            error: (t.squared / f64::from(t.points)).max(0.0).sqrt(),
        })
    });
    Ok(tiles.max_by(|a, b| a.error.total_cmp(&b.error)))
}
