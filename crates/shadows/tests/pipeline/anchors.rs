//! Answers at anchors: for techniques that know no screen they depend on the point alone.

use crate::support::{self, still_life, variant_id};
use umbrage_frame::Anchors;
use umbrage_scene::AreaLight;
use umbrage_shadows::{Calibration, Renderer, Seeding, VariantId};

/// The anchors of the first camera's picture, shaded from either camera; only those that both see.
fn from_two_cameras(variant: VariantId, light: AreaLight) -> Vec<(f32, f32)> {
    let scene = still_life::scene();
    let views = [still_life::camera(), still_life::other_camera()].map(|camera| still_life::view_of(&camera));
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, &scene, 512).expect("fits");
    let anchors = Anchors::of(&renderer.gbuffer(&views[0], &light).expect("rasterises"));
    renderer.set_anchors(&anchors).expect("fits");
    let [first, second] = views.map(|view| {
        let shaded = renderer.shade_anchors(variant, (&view, &light), (Seeding::Frozen, [0, 0]));
        shaded.expect("runs").values
    });
    let in_second = anchors.pixels_in(&views[1]);
    let pairs = first.into_iter().zip(second).zip(in_second);
    pairs.filter_map(|(pair, pixel)| pixel.map(|_| pair)).collect()
}

#[test]
fn techniques_in_light_space_answer_bit_for_bit_the_same_from_any_camera() {
    for name in ["hard", "pcf-grid-11", "pcf-vogel-16"] {
        for calibration in Calibration::ALL {
            for light in [still_life::sun(), still_life::sphere()] {
                let pairs = from_two_cameras(variant_id(name, calibration), light);
                let different = pairs.iter().filter(|(a, b)| a.to_bits() != b.to_bits()).count();
                assert_eq!(different, 0, "{name} {calibration:?} {light:?}");
                let shadowed = pairs.iter().filter(|(a, _)| *a < 1.0).count();
                assert!(pairs.len() > 2000 && shadowed > 200, "{shadowed} of {} shadowed", pairs.len());
            }
        }
    }
}

#[test]
fn a_screen_space_mask_does_depend_on_the_camera() {
    let pairs = from_two_cameras(variant_id("chss-mask", Calibration::LightMatched), still_life::sun());
    let different = pairs.iter().filter(|(a, b)| a != b).count();
    assert!(different > 100, "only {different} anchors differ: the test above would show nothing");
}
