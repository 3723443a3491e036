//! Shared stages: plain functions that add passes to a recording and return the texture written.

mod area;
mod blur;
mod depth;
mod max_filter;
mod min_filter;
mod moments;
mod peel;
mod penumbra_mask;
mod pyramid;
mod resolve;
mod shade;
mod shadow_map;
mod summed_area;
mod surface_blur;
mod target;

pub(crate) use area::Area;
pub(crate) use blur::{BOX_3, Blur, GAUSS_7, blur};
pub(crate) use depth::depth_prepass;
pub(crate) use max_filter::max_filter;
pub(crate) use min_filter::{MinFilter, min_filter, min_shrink};
pub(crate) use moments::{Content, Levels, moments, moments_filtered};
pub(crate) use peel::deeper_layers;
pub(crate) use penumbra_mask::{PenumbraMask, penumbra_mask};
pub(crate) use pyramid::{Reduction, pyramid};
pub(crate) use resolve::{Resolve, resolve};
pub(crate) use shade::{Shade, seeded, seeds, shade};
pub(crate) use shadow_map::{shadow_map, shadow_map_cleared};
pub(crate) use surface_blur::{Likeness, SurfaceBlur, surface_blur};
pub(crate) use target::{Grid, shade_target};
