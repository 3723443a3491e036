//! Error, banding, noise and swimming: pure functions over images. Knows neither scene files nor
//! GPU nor disk.

mod score;

pub use score::Score;
