//! What can be wrong with the inputs of a measurement.

/// Why nothing could be measured. Every case is a mistake of the caller or a broken variant, never a
/// property of a legal picture (those give [`Missing`](crate::Missing)).
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MetricsError {
    /// Two inputs that must describe the same points, frames or pixels do not.
    #[error("{what}: {found} values where {expected} are needed")]
    Length {
        /// Which input.
        what: &'static str,
        /// How many it should hold.
        expected: usize,
        /// How many it holds.
        found: usize,
    },
    /// A count that must be at least one is zero.
    #[error("{0} must be at least 1")]
    Zero(&'static str),
    /// NaN or infinity at a point that counts.
    #[error("{what} is not a finite number at frame {frame}, seed {seed}, point {point}")]
    NotFinite {
        /// Which input.
        what: &'static str,
        /// Frame of the window.
        frame: usize,
        /// Pattern seed (0 for the truth).
        seed: usize,
        /// Point of the panel.
        point: usize,
    },
    /// Tables that were not made from the same tiles, frames or seeds.
    #[error("these tables cannot be combined: {0}")]
    Unlike(&'static str),
    /// A picture smaller than the window that slides over it.
    #[error("a picture of {width}x{height} pixels is smaller than the 11x11 window")]
    TooSmall {
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// What the FLIP library refused.
    #[error("FLIP: {0}")]
    Flip(String),
}

/// An error unless `found` is `expected`.
pub(crate) fn expect_length(what: &'static str, expected: usize, found: usize) -> Result<(), MetricsError> {
    if expected == found { Ok(()) } else { Err(MetricsError::Length { what, expected, found }) }
}
