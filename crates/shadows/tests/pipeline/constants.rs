//! A constant without a value must stop a frame, not shade it with zero.

use crate::support::edited::without_constant;
use crate::support::{self, still_life, variant_id};
use umbrage_shadows::{Calibration, DeviceError, Renderer, Seeding, ShadowError};

#[test]
fn a_forgotten_constant_is_reported_by_the_frame() {
    let scene = still_life::scene();
    let view = still_life::view_of(&still_life::camera());
    let light = still_life::sun();
    let whole = variant_id("pcf-vogel-16", Calibration::LightMatched);
    let broken = without_constant(whole, "FILTER_TAPS");
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, &scene, 64).expect("fits");
    let outcome = renderer.shade_frame(broken, (&view, &light), (Seeding::Frozen, [0, 0]));
    let Err(ShadowError::Device(DeviceError::Refused(message))) = outcome else {
        panic!("a frame without FILTER_TAPS: {outcome:?}")
    };
    assert!(message.contains("FILTER_TAPS"), "{message}");
    // The device is still good.
    renderer.shade_frame(whole, (&view, &light), (Seeding::Frozen, [0, 0])).expect("runs");
}
