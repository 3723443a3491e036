//! What the adapter computed against a plain re-implementation (the twins), per pixel and per
//! stage. Every stage starts from the targets that the pipeline itself wrote before it, so that a
//! difference is found where it arises.
//!
//! A result must lie within the bound that running error analysis derives for it. Where rounding
//! may decide a comparison or a choice of texel, both outcomes are allowed and the receiver counts
//! as open; the share of those has a limit, and `planted` proves that what is left is strict.

#[path = "../support/mod.rs"]
mod support;
#[path = "../twins/mod.rs"]
mod twins;

mod bands;
mod case;
mod deep;
mod fewer;
mod fragments;
mod moments;
mod planted;
mod stages;
mod variants;
