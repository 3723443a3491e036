//! The stages before the last pass: penumbra mask, blurs, minimum filter.

use crate::case::{Case, MAP_TEXELS, Ran};
use crate::support::{still_life, variant_id};
use crate::twins::approx::Approx;
use crate::twins::light::Law;
use crate::twins::screen::{blurred, smallest};
use crate::twins::variants::MASK_STEP;
use umbrage_frame::Image;
use umbrage_scene::AreaLight;
use umbrage_shadows::Calibration;

fn cases(name: &str) -> Vec<Case> {
    let lights = [still_life::sun(), still_life::sphere()];
    let under = |light: AreaLight| Calibration::ALL.map(|c| Case::new(variant_id(name, c), light));
    lights.into_iter().flat_map(under).collect()
}

/// Every texel of an image against what may be there; `None` where anything may.
fn compare(image: &Image<f32>, what: &str, expected: impl Fn([u32; 2]) -> Option<Vec<Approx>>) -> usize {
    let mut open = 0;
    for (index, &value) in image.pixels().iter().enumerate() {
        let texel = [index as u32 % image.width(), index as u32 / image.width()];
        let Some(alternatives) = expected(texel) else {
            open += 1;
            continue;
        };
        open += usize::from(alternatives.len() > 1);
        let admitted = alternatives.iter().any(|a| a.admits(value));
        assert!(admitted, "{what}: {texel:?} is {value}, not any of {alternatives:?}");
    }
    open
}

/// Share of mask texels that a rounding may decide: as for `chss` at pixels, and as printed the 255
/// levels of the stored radius.
const OPEN_MASK_SHARE: f64 = 0.08;

/// The mask against its twin; panics where a texel is wrong.
pub(crate) fn check_mask(ran: &Ran) {
    let (light, mask) = (ran.light(), ran.image("penumbra-mask"));
    let twin = ran.twin(&light, 1);
    let (width, height) = still_life::SIZE;
    assert_eq!((mask.width(), mask.height()), (width.div_ceil(MASK_STEP), height.div_ceil(MASK_STEP)));
    let open = compare(mask, &format!("mask of {}", ran.case.variant.name()), |[x, y]| {
        // The pixel at the block's centre.
        let pixel = [(x * MASK_STEP + 2).min(width - 1), (y * MASK_STEP + 2).min(height - 1)];
        twin.mask(ran.surface(pixel).as_ref(), [x, y])
    });
    let share = open as f64 / mask.pixels().len() as f64;
    assert!(share <= OPEN_MASK_SHARE, "{share} of the mask is open");
    let wide = mask.pixels().iter().filter(|&&r| r > 0.0).count();
    assert!(wide >= 10, "only {wide} texels have a penumbra: nothing was tested");
}

#[test]
fn the_penumbra_mask_equals_its_twin() {
    cases("chss-mask").iter().for_each(|case| check_mask(&case.run()));
}

/// Weights of a Gaussian of standard deviation 3 over seven pixels, each integrated over its pixel
/// (midpoint rule), from the middle outwards.
fn gaussian() -> Vec<Approx> {
    let density = |x: f64| (-0.5 * (x / 3.0).powi(2)).exp();
    let steps = 1000;
    let pixel = |k: i32| {
        let at = |i: i32| f64::from(k) - 0.5 + (f64::from(i) + 0.5) / f64::from(steps);
        (0..steps).map(|i| density(at(i))).sum::<f64>() / f64::from(steps)
    };
    let total: f64 = (-3..=3).map(pixel).sum();
    // The document prints six decimals.
    (0..=3).map(|k| Approx { value: pixel(k) / total, error: 0.5e-6 }).collect()
}

/// The mask's blur against a Gaussian in two dimensions.
pub(crate) fn check_mask_blur(ran: &Ran) {
    let (source, weights) = (ran.image("penumbra-mask"), gaussian());
    compare(ran.image("penumbra-mask-blurred"), "blurred mask", |t| Some(vec![blurred(source, &weights, t)]));
}

#[test]
fn the_masks_blur_is_a_gaussian_of_sigma_3() {
    cases("chss-mask").iter().for_each(|case| check_mask_blur(&case.run()));
}

/// The minimum map against the smallest depth of each region of the shadow map, exactly: a minimum
/// does not round.
pub(crate) fn check_min_map(ran: &Ran) {
    let (light, map) = (ran.light(), ran.image("shadow-map"));
    let law = Law { light: &light, calibration: ran.case.variant.calibration };
    let reach = i64::from(law.region());
    let minimum = ran.image("min-map");
    assert_eq!(minimum.width(), MAP_TEXELS.div_ceil(4));
    compare(minimum, &format!("minimum over {reach}"), |texel| {
        let low = texel.map(|c| 4 * (i64::from(c) - reach));
        let high = texel.map(|c| 4 * (i64::from(c) + reach) + 3);
        Some(vec![smallest(map, low, high).into()])
    });
}

#[test]
fn the_minimum_map_equals_a_brute_force_minimum() {
    cases("chss-min").iter().for_each(|case| check_min_map(&case.run()));
}

/// The minimum map's blur against the mean of nine texels.
pub(crate) fn check_min_blur(ran: &Ran) {
    let third = [Approx::constant(1.0 / 3.0); 2];
    let source = ran.image("min-map");
    compare(ran.image("min-map-blurred"), "blurred minimum", |t| Some(vec![blurred(source, &third, t)]));
}

#[test]
fn the_minimum_maps_blur_is_a_mean_of_nine() {
    cases("chss-min").iter().for_each(|case| check_min_blur(&case.run()));
}
