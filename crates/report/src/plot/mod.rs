//! Plots as inline SVG: no script, sharp in print, colours from the page's style sheet.

mod axis;
mod look;
mod pareto;
mod per_frame;
mod spectrum;
mod strip;

pub(crate) use axis::{Axis, Target};
pub(crate) use look::{Look, swatch};
pub(crate) use pareto::pareto;
pub(crate) use per_frame::per_frame;
pub(crate) use spectrum::spectrum;
pub(crate) use strip::strip;
