//! Proofs of ground truth: what must hold whoever rewrites the tracer.

mod agreement;
mod cache;
mod closed_forms;
mod common;
mod cutouts;
mod exact;
mod gpu;
mod independence;
mod irradiance;
mod pitfalls;
mod primary;
mod refine;
mod sampling;
