//! What can go wrong between a scene and a mask.

/// Why a frame could not be rendered.
#[derive(Debug, thiserror::Error)]
pub enum ShadowError {
    /// No Vulkan, Metal or DirectX 12 adapter, or none of the wanted name.
    #[error(
        "no graphics adapter{wanted}; found: {found}\n  help: on Debian `apt-get install mesa-vulkan-drivers libvulkan1` \
         installs a software driver (lavapipe); `umbrage list adapters` shows what is there"
    )]
    NoAdapter {
        /// " named ..." or nothing.
        wanted: String,
        /// Names of those found.
        found: String,
    },
    /// A graphics interface that this program does not use.
    #[error("unknown graphics interface \"{wanted}\"\n  help: choose vulkan, metal or dx12")]
    UnknownBackend {
        /// As it was given.
        wanted: String,
    },
    /// The adapter refused to give a device.
    #[error("the adapter {adapter} gives no device: {reason}")]
    NoDevice {
        /// Its name.
        adapter: String,
        /// The driver's words.
        reason: String,
    },
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
    /// A shader or pass that the driver or its validation refused.
    #[error("the graphics driver refused the work: {0}")]
    Gpu(String),
    /// The driver did not answer.
    #[error("the graphics driver did not finish within {secs} s")]
    Timeout {
        /// How long it was waited for.
        secs: u64,
    },
}
