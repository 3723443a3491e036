//! What can go wrong between a program and a GPU.

/// Why a device did not do its work.
#[derive(Debug, thiserror::Error)]
pub enum DeviceError {
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
    /// A buffer larger than the adapter takes.
    #[error("a buffer of {wanted} bytes exceeds this adapter's limit of {limit}")]
    TooLarge {
        /// Bytes.
        wanted: u64,
        /// What the adapter allows.
        limit: u64,
    },
    /// A shader or pass that the driver or its validation refused.
    #[error("the graphics driver refused the work: {0}")]
    Refused(String),
    /// The driver did not answer.
    #[error("the graphics driver did not finish within {secs} s")]
    Timeout {
        /// How long it was waited for.
        secs: u64,
    },
}
