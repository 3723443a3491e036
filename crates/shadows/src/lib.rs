//! The wgpu pipeline: contact-hardening soft shadows and every other technique, on real passes.
//!
//! A technique writes a [`Recording`], plain data; only `gpu` knows wgpu. Nothing here knows the
//! ground truth: the pipeline rasterises its own depth, so that a wrong matrix shows.

mod blue_noise;
mod calibration;
mod error;
mod gpu;
mod kernels;
mod layout;
mod light_map;
mod map_depths;
mod own;
mod recording;
mod renderer;
mod shader;
mod stages;
mod technique;
mod techniques;
mod triangles;

pub use calibration::{Bias, ConstantBias, ReceiverPlane};
pub use error::ShadowError;
pub use gpu::{Gpu, Timing};
pub use kernels::Kernels;
pub use layout::Globals;
pub use light_map::{LightKind, LightMap};
pub use own::Own;
pub use recording::{Binding, ComputePass, Format, Pass, RasterPass, Recording, TextureId, TextureInfo};
pub use renderer::{Dump, Renderer, Shaded};
pub use shader::{Fragment, fragments};
pub use technique::{
    Calibration, Info, Inputs, Lights, Projection, Receivers, Seeding, Technique, Variant, VariantId,
    select_variants,
};
pub use techniques::{PROBES, VARIANTS};
pub use umbrage_device::{AdapterChoice, AdapterDescription, DeviceError, adapters};
