//! What techniques with a history promise on a still camera: they say what a technique without one
//! says that computes everything in this frame.

use crate::support::edited::{swapped, with_change};
use crate::support::{self, still_life, variant_id};
use umbrage_shadows::{Calibration, Dump, Pass, Recording, Renderer, Seeding, VariantId};

/// Values of a picture and every target, with a pattern that is the same in each frame.
fn still(variant: VariantId, frame: u32) -> (Vec<f32>, Vec<Dump>) {
    let scene = still_life::scene();
    let view = still_life::view_of(&still_life::camera());
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, &scene, 500).expect("fits");
    let how = (Seeding::Frozen, [frame, 3]);
    let (shaded, dumps) = renderer.dump(variant, (&view, &still_life::sun()), how).expect("runs");
    (shaded.values, dumps)
}

fn target<'a>(dumps: &'a [Dump], label: &str) -> &'a [f32] {
    dumps.iter().find(|d| d.label == label).expect("a target").channels[0].pixels()
}

/// A place in the frame before is known to 1e-4 pixels (two matrix products and a quotient at f32, on
/// a hundred pixels): up to twice that much of the weight goes to its neighbours. A checkerboard of
/// the wrong parity, or half a pixel, would show in whole penumbrae.
const PLACE: f32 = 5e-4;

#[test]
fn two_halves_of_a_still_camera_are_contact_hardening_at_every_pixel() {
    for calibration in Calibration::ALL {
        // Full resolution with the checkerboard's own noise.
        let full = swapped(variant_id("chss", calibration), "pattern_ign", "pattern_ign_tall");
        for frame in [4, 5] {
            let (expected, _) = still(full, frame);
            let (halves, _) = still(variant_id("temporal-checker", calibration), frame);
            for (k, (a, b)) in halves.iter().zip(&expected).enumerate() {
                assert!((a - b).abs() <= PLACE, "{calibration:?}, frame {frame}, pixel {k}: {a} and {b}");
            }
        }
    }
}

/// Four quarters against the mask of `chss-mask` with a texel per pixel, and everything after it: the
/// same formulas in the same precision, so exactly.
#[test]
fn four_quarters_of_a_still_camera_are_a_mask_at_full_resolution() {
    for calibration in Calibration::ALL {
        for frame in [4, 5, 6, 7] {
            let (values, quarters) = still(variant_id("temporal-mask", calibration), frame);
            let (expected, whole) = still(full_resolution_mask(calibration), frame);
            let mask = |dumps| target(dumps, "penumbra-mask");
            assert!(mask(&quarters).iter().any(|&radius| radius > 0.0));
            assert!(mask(&quarters) == mask(&whole), "{calibration:?}, frame {frame}: masks differ");
            assert!(values == expected, "{calibration:?}, frame {frame}: shadows differ");
        }
    }
}

/// `chss-mask` with a mask texel per pixel.
fn full_resolution_mask(calibration: Calibration) -> VariantId {
    let change = |recording: &mut Recording| {
        let (width, height) = still_life::SIZE;
        let masks = recording.textures.iter_mut().filter(|t| t.label.starts_with("penumbra-mask"));
        masks.for_each(|mask| (mask.width, mask.height) = (width, height));
        for pass in &mut recording.passes {
            let Pass::Compute(pass) = pass else { continue };
            pass.groups = [width.div_ceil(8), height.div_ceil(8)];
            pass.constants.iter_mut().filter(|c| c.0 == "MASK_STEP").for_each(|c| c.1 = 1.0);
        }
    };
    with_change(variant_id("chss-mask", calibration), Box::new(change))
}
