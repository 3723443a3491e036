//! What became of claims: cards, and the pages made from them.
//!
//! Deliberately absent: the rule. A verdict is decided by whoever measured (docs/claims.md) and
//! written down here.

mod card;
mod crop;
mod markdown;
mod page;
mod words;
mod write;

pub use card::{
    ClaimCard, ClaimPart, ClaimsCard, ClaimsProvenance, CostOrigin, DocumentTime, EffectKind, Outcome,
    PlaceEffect, Verdict,
};
pub use crop::{Crop, CropPanel};
pub use write::{publish_claims, write_claims};
