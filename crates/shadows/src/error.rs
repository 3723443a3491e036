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
    /// A user's technique that cannot be: its header or its WGSL.
    #[error("{file}:{}:{}: {message}", place.0, place.1)]
    Own {
        /// The file as it was named.
        file: String,
        /// Line and column, from 1.
        place: (usize, usize),
        /// What is wrong there.
        message: String,
    },
    /// A constant of a user's technique that was set and cannot be.
    #[error("--set {name}: {message}")]
    Setting {
        /// The technique.
        name: String,
        /// What is wrong.
        message: String,
    },
    /// A user's technique that answered with something else than a fraction.
    #[error(
        "{name} ({file}) returned {what}\n  help: `shade` returns the unoccluded fraction of the light, 0 to 1"
    )]
    Value {
        /// The technique.
        name: String,
        /// Its file.
        file: String,
        /// The value and where.
        what: String,
    },
    /// A user's technique that did not come to an end.
    #[error("{name} ({file}) did not finish a frame within {secs} s\n  help: does every loop end?")]
    Endless {
        /// The technique.
        name: String,
        /// Its file.
        file: String,
        /// How long it was waited for.
        secs: u64,
    },
}
