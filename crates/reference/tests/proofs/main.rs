//! Proofs of ground truth: what must hold whoever rewrites the tracer.

mod agreement;
mod common;
