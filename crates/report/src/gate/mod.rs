//! The gate: a run against what is known to be good.

mod baseline;
mod card;
mod compare;
mod crops;
mod margins;

pub use baseline::{BASELINE_VERSION, Baseline, BaselineSums, BaselineWindow, SUMS};
pub use card::{ChangeCard, GateCard, GateCase, Side};
pub use compare::{compare, not_comparable};
pub use crops::write_gate_crops;
pub use margins::{MarginCard, Margins, gated};

pub(crate) use card::{ACCEPT, GATE, MEASURE, short, short_up};
pub(crate) use crops::{BEFORE, FOLDER as CROPS};
