//! What the pipeline promises as a whole, on an adapter: a shadow map that a ray cast confirms,
//! answers that belong to surface points, maps that are kept, patterns that are fresh, and biases
//! that move shadows as far as they say.

#[path = "../support/mod.rs"]
mod support;

mod anchors;
mod bias;
mod constants;
mod coverage;
mod depth;
mod early_bounds;
mod history;
mod kept_maps;
mod layers;
mod nearest;
mod pyramids;
mod seeding;
