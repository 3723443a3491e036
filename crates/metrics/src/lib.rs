//! Error, banding, noise and swimming: pure functions over images. Knows neither scene files nor
//! GPU nor disk, and never prints.
//!
//! A window's way through this crate: [`Tiling::new`] sorts the counted anchors into regions and
//! tiles, once; [`window_tiles`] reduces each variant's [`Panel`] to a small [`TileTable`];
//! [`cells`] pools tables to scores with intervals, [`paired`] compares two variants.

mod bootstrap;
mod cells;
mod error;
mod estimator;
mod paired;
mod panel;
mod projection;
mod quantity;
mod regions;
mod registry;
mod score;
mod swimming;
mod tiles;
mod tiling;

pub use bootstrap::Bootstrap;
pub use cells::{Cells, cells};
pub use error::MetricsError;
pub use estimator::Parts;
pub use paired::{edge_crawl, paired};
pub use panel::{Panel, PanelTruth};
pub use projection::Projection;
pub use quantity::Quantity;
pub use regions::{Coverage, Region, counted};
pub use registry::{Direction, METRICS, MetricInfo, metric};
pub use score::{Measurement, Missing, Score};
pub use swimming::swimming_per_frame;
pub use tiles::{Outside, TileRow, TileTable, window_tiles};
pub use tiling::{TILE_PX, Tile, Tiling};
