//! The pipeline's formulas once more, in f64 and with error bounds, from their definitions: the
//! seed document's listings, TECHNIQUES and the doc comments of the crate, not from its WGSL.

pub(crate) mod approx;
pub(crate) mod light;
pub(crate) mod map;
pub(crate) mod pattern;
pub(crate) mod plain;
pub(crate) mod pyramid;
pub(crate) mod screen;
pub(crate) mod variants;
