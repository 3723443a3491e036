//! What the tests share: an adapter, a small scene, and techniques whose WGSL is edited on the way.
#![allow(dead_code, reason = "each test program uses a part of it")]

pub(crate) mod edited;
pub(crate) mod still_life;

use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use umbrage_shadows::{
    AdapterChoice, Calibration, Gpu, Inputs, LightMap, Receivers, Recording, Seeding, VARIANTS, Variant,
    VariantId,
};

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

/// A variant's passes over a frame of the still life, as data: under the sun, or under the sphere for
/// those that want a light with a place.
pub(crate) fn recording_of(id: VariantId, texels: u32) -> Recording {
    let technique = id.variant.technique;
    let light = still_life::light_for(id);
    let map = LightMap::with(&still_life::scene(), &light, (texels, technique.projection()));
    let view = still_life::view_of(&still_life::camera());
    let past = [view; 3];
    let inputs = Inputs {
        view: &view,
        light: &map,
        calibration: id.calibration,
        bias: id.calibration.default_bias(),
        receivers: Receivers::Frame,
        seeding: Seeding::Fresh,
        geometry_key: 0,
        has_cutouts: false,
        past: &past,
        age: 0,
    };
    inputs.recorded(id, [0, 0])
}
