//! What the tests share: an adapter, a small scene, and techniques whose WGSL is edited on the way.
#![allow(dead_code, reason = "each test program uses a part of it")]

pub(crate) mod edited;
pub(crate) mod still_life;

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use umbrage_shadows::{AdapterChoice, Calibration, Gpu, VARIANTS, Variant, VariantId};

/// The one device of a test program. Fails, and never skips, where there is no adapter.
pub(crate) fn gpu() -> MutexGuard<'static, Gpu> {
    static GPU: OnceLock<Mutex<Gpu>> = OnceLock::new();
    let open = || {
        let gpu = Gpu::new(&AdapterChoice::default());
        Mutex::new(gpu.expect("these tests need a graphics adapter; on Debian, `apt-get install mesa-vulkan-drivers libvulkan1` installs a software one"))
    };
    // A test that failed while it held the device leaves it usable.
    GPU.get_or_init(open).lock().unwrap_or_else(PoisonError::into_inner)
}

/// A variant by name.
pub(crate) fn variant(name: &str) -> &'static Variant {
    VARIANTS.iter().find(|v| v.name == name).unwrap_or_else(|| panic!("no variant {name}"))
}

/// A variant in a calibration.
pub(crate) fn variant_id(name: &str, calibration: Calibration) -> VariantId {
    VariantId { variant: variant(name), calibration }
}
