//! Error, banding, noise and swimming: pure functions over images. Knows neither scene files nor
//! GPU nor disk, and never prints.
//!
//! A window's way through this crate: [`Tiling::new`] sorts the counted anchors into regions and
//! tiles, once; [`window_tiles`] reduces each variant's [`Panel`] to a small [`TileTable`];
//! [`cells`] pools tables to scores with intervals, [`paired`] compares two variants.

mod bootstrap;
mod cells;
mod edges;
mod error;
mod estimator;
mod flip;
mod gate;
mod grain;
mod groups;
mod interval;
mod maps;
mod medians;
mod paired;
mod panel;
mod pooled;
mod profile;
mod projection;
mod quantity;
mod regions;
mod registry;
mod rng;
mod score;
mod seeds;
mod spectrum;
mod ssim;
mod staircase;
mod swimming;
mod tails;
mod tiles;
mod tiling;

pub use bootstrap::Bootstrap;
pub use cells::{Cells, cells};
pub use error::MetricsError;
pub use estimator::Parts;
pub use flip::{PictureScore, Viewing, flip};
pub use gate::{Change, GATED, Margin, Reading, Trial, Verdict, judge};
pub use grain::{Grain, GrainTable, grain, window_grain};
pub use groups::{Comparisons, compare_all, group_letters};
pub use maps::{PointMaps, point_maps};
pub use medians::compare_medians;
pub use paired::{edge_crawl, paired};
pub use panel::{Panel, PanelTruth};
pub use pooled::{
    Member, PooledNumber, SumKind, SumTable, against_sums, block_sums, compare_jointly, value_sums,
    width_sums,
};
pub use profile::{ProfileTable, Profiles, profiles, window_profiles};
pub use projection::Projection;
pub use quantity::Quantity;
pub use regions::{Coverage, Region, counted};
pub use registry::{Direction, METRICS, MetricInfo, metric};
pub use score::{Measurement, Missing, Score};
pub use seeds::{SeedSpread, gate_table, pooled_reading, seed_spread};
pub use spectrum::SPECTRUM_FREQUENCIES;
pub use ssim::ssim;
pub use swimming::swimming_per_frame;
pub use tails::{Tail, TailTable, WORST_TILE_POINTS, WorstTile, percentile, window_tails, worst_tile};
pub use tiles::{Outside, TileRow, TileTable, window_tiles};
pub use tiling::{TILE_PX, Tile, Tiling};
