//! What can go wrong between a scene and a mask.

use umbrage_device::DeviceError;

/// Why a frame could not be rendered.
#[derive(Debug, thiserror::Error)]
pub enum ShadowError {
    /// No adapter, no device, or work that the driver refused.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// Larger than the adapter's textures or buffers.
    #[error(
        "{what} of {wanted} exceeds this adapter's limit of {limit}\n  help: choose a smaller --size or shadow map"
    )]
    TooLarge {
        /// "a picture", "a shadow map", "a buffer".
        what: &'static str,
        /// Pixels or bytes a side.
        wanted: u64,
        /// What the adapter allows.
        limit: u64,
    },
    /// A technique asked for a light that it cannot do.
    #[error("{variant} cannot do {light}: it does {wants} only\n  help: these can: {able}")]
    WrongLight {
        /// The variant.
        variant: String,
        /// "a sun", "a light that has a place".
        light: &'static str,
        /// What it can do.
        wants: &'static str,
        /// Names of variants that can do this light.
        able: String,
    },
}
