//! Error, banding, noise and swimming: pure functions over images. Knows neither scene files nor
//! GPU nor disk, and never prints.
//!
//! A window's way through this crate: [`Tiling::new`] sorts the counted anchors into regions and
//! tiles, once; [`window_tiles`] reduces each variant's [`Panel`] to a small [`TileTable`];
//! [`cells`] pools tables to scores with intervals, [`paired`] compares two variants.
//!
//! In a test of your own: a floor of 64x64 pixels, a penumbra across it, and a shadow that is everywhere .1 too
//! light. All of its error stands still and is smooth.
//!
//! ```
//! use glam::{Mat4, Vec3};
//! use umbrage_frame::{Anchors, View};
//! use umbrage_metrics::{Bootstrap, Panel, PanelTruth, Quantity, TILE_PX, Tiling, cells, window_tiles};
//!
//! let side = 64;
//! let view = View {
//!     width: side,
//!     height: side,
//!     clip_from_world: Mat4::IDENTITY,
//!     camera_from_world: Mat4::IDENTITY,
//!     yfov_radians: 1.0,
//! };
//! let at = |pixel: u32| [pixel % side, pixel / side].map(|v| v as f32);
//! let pixel: Vec<u32> = (0..side * side).collect();
//! let anchors = Anchors {
//!     view,
//!     position: pixel.iter().map(|&p| Vec3::new(at(p)[0], 0.0, at(p)[1])).collect(),
//!     normal: vec![Vec3::Y; pixel.len()],
//!     pixel: pixel.clone(),
//! };
//! // Truth: from 0 on the left to 1 on the right; exact, so both halves are alike.
//! let g: Vec<f32> = pixel.iter().map(|&p| (at(p)[0] + 0.5) / side as f32).collect();
//! let truth = PanelTruth {
//!     frames: 1,
//!     halves: [g.clone(), g.clone()],
//!     basis: g.clone(),
//!     variance: vec![0.0; g.len()],
//! };
//! let tiling = Tiling::new(&anchors, &truth, &vec![true; g.len()], TILE_PX)?;
//! // What was rendered: four frames, one seed.
//! let (frames, seeds) = (4, 1);
//! let values: Vec<f32> = (0..frames).flat_map(|_| g.iter().map(|v| v + 0.1)).collect();
//! let panel = Panel { points: g.len(), frames, seeds, values };
//!
//! let table = window_tiles(&panel, &truth, &tiling)?;
//! let cells = cells(&[&table], &Bootstrap::default())?;
//! let score = |quantity: Quantity| cells.get(quantity).score().map(|s| s.value).unwrap_or(f64::NAN);
//! assert!((score(Quantity::Error) - 0.1).abs() < 1e-6);
//! assert!(score(Quantity::Banding).abs() < 1e-9 && score(Quantity::Swimming).abs() < 1e-9);
//! # Ok::<(), umbrage_metrics::MetricsError>(())
//! ```

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
    Member, PooledNumber, SumKind, SumTable, against_sums, block_sums, compare_jointly, true_widths,
    value_sums, width_sums,
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
