//! An adapter, its device, and bytes to and from it.
//!
//! A leaf: what the pipeline and the ground truth both need of a GPU before either computes anything.
//! It knows no scene, no shader and no shadow, so that the two stay independent witnesses.

mod adapter;
mod device;
mod error;

pub use adapter::{AdapterChoice, AdapterDescription, adapters};
pub use device::Device;
pub use error::DeviceError;
