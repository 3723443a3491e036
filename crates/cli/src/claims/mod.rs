//! The claims of the seed documents: data in `claims.toml`, measured here, judged by the rule of
//! docs/claims.md.

mod assemble;
mod costs;
mod crops;
mod engine;
mod exact;
mod judge;
mod measurements;
mod needs;
mod numbers;
mod place;
mod registry;
mod rule;
mod store;
mod subject;
mod ways;

pub(crate) use assemble::assemble;
pub(crate) use costs::{CostBook, measure_costs};
pub(crate) use engine::{Settings, run};
pub(crate) use judge::Judge;
pub(crate) use needs::{cost_needs, needs};
pub(crate) use registry::{Claim, Registry};
