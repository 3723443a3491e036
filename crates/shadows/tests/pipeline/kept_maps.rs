//! What a static light or view costs once, and when it is paid again: by the labels of the passes that ran.

use crate::support::{self, still_life, variant_id};
use glam::{Quat, Vec3};
use umbrage_scene::{AreaLight, Camera, Scene};
use umbrage_shadows::{Calibration, Gpu, Renderer, Seeding};

/// Passes of the light's side, in order.
const OF_THE_LIGHT: [&str; 5] = ["shadow-map", "min-shrink", "min-rows", "min-map", "min-map-blurred"];
/// Passes of the camera's side.
const OF_THE_CAMERA: [&str; 2] = ["depth-prepass", "chss-min"];

fn sun_at(azimuth: f32) -> AreaLight {
    let direction_to_light = Quat::from_rotation_y(azimuth) * Vec3::new(0.6, 0.7, 0.1).normalize();
    AreaLight::Sun { direction_to_light, angular_diameter_radians: 0.03 }
}

/// Labels of the passes that a frame ran, sorted; the camera stands farther right in each.
fn passes(renderer: &mut Renderer<'_>, (frame, light): (u32, &AreaLight)) -> Vec<&'static str> {
    let aside = Vec3::X * 0.1 * frame as f32;
    let camera = Camera::look_at(Vec3::new(2.3, 1.9, 3.3) + aside, Vec3::ZERO, 0.9, 0.1, 40.0);
    let variant = variant_id("chss-min", Calibration::LightMatched);
    let from = (&still_life::view_of(&camera), light);
    let shaded = renderer.shade_frame(variant, from, (Seeding::Fresh, [0, 0])).expect("runs");
    sorted(shaded.timings.iter().map(|timing| timing.label).collect())
}

fn renderer<'a>(gpu: &'a mut Gpu, scene: &'a Scene) -> Renderer<'a> {
    Renderer::new(gpu, scene, 128).expect("fits")
}

fn all() -> Vec<&'static str> {
    sorted(OF_THE_LIGHT.into_iter().chain(OF_THE_CAMERA).collect())
}

fn sorted(mut labels: Vec<&'static str>) -> Vec<&'static str> {
    labels.sort_unstable();
    labels
}

#[test]
fn a_static_light_over_a_static_scene_is_rendered_once() {
    let (scene, mut gpu) = (still_life::scene(), support::gpu());
    let mut renderer = renderer(&mut gpu, &scene);
    assert_eq!(passes(&mut renderer, (0, &sun_at(0.0))), all());
    for frame in 1..3 {
        assert_eq!(passes(&mut renderer, (frame, &sun_at(0.0))), sorted(OF_THE_CAMERA.to_vec()));
    }
}

#[test]
fn a_static_view_is_rasterised_once() {
    let (scene, mut gpu) = (still_life::scene(), support::gpu());
    let mut renderer = renderer(&mut gpu, &scene);
    passes(&mut renderer, (0, &sun_at(0.6)));
    assert_eq!(passes(&mut renderer, (0, &sun_at(0.6))), ["chss-min"]);
    assert_eq!(passes(&mut renderer, (1, &sun_at(0.6))), sorted(OF_THE_CAMERA.to_vec()));
}

#[test]
fn a_moved_light_is_rendered_again() {
    let (scene, mut gpu) = (still_life::scene(), support::gpu());
    let mut renderer = renderer(&mut gpu, &scene);
    for (frame, azimuth) in (0..).zip([0.1, 0.2, 0.1]) {
        assert_eq!(passes(&mut renderer, (frame, &sun_at(azimuth))), all(), "azimuth {azimuth}");
    }
}

#[test]
fn a_changed_scene_is_rendered_again_and_another_renderer_of_the_same_is_not() {
    let mut gpu = support::gpu();
    let mut scene = still_life::scene();
    passes(&mut renderer(&mut gpu, &scene), (0, &sun_at(0.3)));
    let again = passes(&mut renderer(&mut gpu, &scene), (1, &sun_at(0.3)));
    assert_eq!(again, sorted(OF_THE_CAMERA.to_vec()));
    // One vertex, by a millimetre.
    scene.geometry.positions[20].y -= 0.001;
    let changed = passes(&mut renderer(&mut gpu, &scene), (1, &sun_at(0.3)));
    assert_eq!(changed, all());
}

#[test]
fn what_is_forgotten_is_rendered_again() {
    let (scene, mut gpu) = (still_life::scene(), support::gpu());
    let mut renderer = renderer(&mut gpu, &scene);
    passes(&mut renderer, (0, &sun_at(0.5)));
    renderer.forget();
    assert_eq!(passes(&mut renderer, (0, &sun_at(0.5))), all());
}

#[test]
fn what_was_kept_is_what_would_be_rendered() {
    let (scene, mut gpu) = (still_life::scene(), support::gpu());
    let view = still_life::view_of(&still_life::camera());
    let mut renderer = renderer(&mut gpu, &scene);
    // The calibrations filter other regions of the same map: neither may see the other's.
    let mut shade = |calibration| {
        let variant = variant_id("chss-min", calibration);
        let shaded = renderer.shade_frame(variant, (&view, &sun_at(0.4)), (Seeding::Frozen, [0, 0]));
        shaded.expect("runs").values
    };
    let [a, b] = [Calibration::LightMatched, Calibration::AsPrinted].map(&mut shade);
    assert!(a != b, "the calibrations look the same");
    for _ in 0..2 {
        assert!(a == shade(Calibration::LightMatched));
        assert!(b == shade(Calibration::AsPrinted));
    }
}
