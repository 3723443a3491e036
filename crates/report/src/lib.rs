//! Turns a stored run into pages, and says how a run is stored.
//!
//! A run is a folder: [`Scorecard`] (`scorecard.json`) and the planes of its pictures. [`RunWriter`]
//! fills it while the run goes on; [`write_report`] makes the pages from it, then or at any later
//! time. Deliberately absent: rendering, measuring, the clock and the network. What is not in the
//! folder is not on the page.

mod book;
mod card;
mod claims;
mod error;
mod figure;
mod gate;
mod numbers;
mod page;
mod picture;
mod plot;
mod store;
mod tables;
mod trace;
mod viewer;
mod words;
mod write;

pub use card::{
    AdapterCard, Calibration, Cost, Direction, Measured, MetricCard, OverallCard, PairedCard, PassCost,
    Provenance, ResultCard, SCHEMA_VERSION, SceneCard, Scorecard, SettingsCard, TruthCard, VariantCard,
    WindowCard, scorecard_schema,
};
pub use claims::{
    ClaimCard, ClaimPart, ClaimsCard, ClaimsProvenance, CostOrigin, Crop, CropPanel, DocumentTime,
    EffectKind, Outcome, PlaceEffect, Verdict, publish_claims, write_claims,
};
pub use error::ReportError;
pub use figure::{FigureRequest, write_figures};
pub use gate::{
    BASELINE_VERSION, Baseline, BaselineSums, BaselineWindow, ChangeCard, GateCard, GateCase, MarginCard,
    Margins, SUMS, Side, compare, gated, not_comparable, write_gate_crops,
};
pub use store::{CELLS, CellMaps, RunWriter, Surface, VariantPictures, WindowPictures};
pub use write::{Layout, Written, write_report};

// Unit tests read the same made-up run as the tests outside, which know this crate by its name.
#[cfg(test)]
extern crate self as umbrage_report;
#[cfg(test)]
#[expect(dead_code, reason = "unit tests need its scorecard only")]
#[path = "../tests/fixture/mod.rs"]
mod fixture;
