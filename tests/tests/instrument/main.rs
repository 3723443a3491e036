//! The instrument calibrated on real sequences: what is known of a technique must come out of its
//! scores, and what is known of truth must come out of truth.

mod agreement;
mod leaves;
mod lights;
mod runs;
mod swimming;
mod truth;
mod views;
