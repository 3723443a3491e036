//! A pyramid's early-outs change no pixel: `chss-minmax` is `chss`, bit for bit, and spares most of
//! its fetches. No tolerance: one pixel that differs is an early-out that was not allowed.

use crate::support::edited::{Edit, with_edit};
use crate::support::{self, still_life, variant_id};
use glam::{Quat, Vec3};
use umbrage_frame::View;
use umbrage_scene::{AreaLight, Camera, Scene};
use umbrage_shadows::{Calibration, PROBES, Renderer, Seeding, VariantId};

/// A map whose side no power of two divides, and one that it does.
const MAPS: [u32; 2] = [500, 512];

fn shade(renderer: &mut Renderer<'_>, variant: VariantId, from: (&View, &AreaLight)) -> Vec<f32> {
    renderer.shade_frame(variant, from, (Seeding::Fresh, [3, 7])).expect("runs").values
}

fn pixels(view: &View) -> f64 {
    f64::from(view.width * view.height)
}

fn fetches(calibration: Calibration) -> VariantId {
    let variant = PROBES.iter().find(|v| v.name == "chss-minmax-fetches").expect("a probe");
    VariantId { variant, calibration }
}

/// Pixels that differ from `chss`, and how many the early-outs decided.
fn differing(renderer: &mut Renderer<'_>, minmax: VariantId, from: (&View, &AreaLight)) -> (usize, usize) {
    let chss = shade(renderer, variant_id("chss", minmax.calibration), from);
    let same = shade(renderer, minmax, from);
    let share = shade(renderer, fetches(minmax.calibration), from);
    let apart = chss.iter().zip(&same).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
    (apart, share.iter().filter(|&&s| s < 1.0).count())
}

/// Every calibration and map size from a place.
fn check(scene: &Scene, (view, lights): (&View, &[AreaLight])) {
    let mut gpu = support::gpu();
    for texels in MAPS {
        let mut renderer = Renderer::new(&mut gpu, scene, texels).expect("fits");
        for light in lights {
            for calibration in Calibration::ALL {
                let minmax = variant_id("chss-minmax", calibration);
                let (apart, early) = differing(&mut renderer, minmax, (view, light));
                assert_eq!(apart, 0, "{} {light:?} {texels}: pixels differ", scene.name);
                // As printed a constant bias admits lit ones as well; a receiver's plane leaves
                // little room between itself and its own texels.
                let least = if calibration == Calibration::AsPrinted { 0.05 } else { 0.008 };
                let share = early as f64 / pixels(view);
                assert!(share > least, "{light:?} {texels}: only {share} early");
            }
        }
    }
}

#[test]
fn the_still_life_is_the_same_pixel_for_pixel() {
    let lights = [still_life::sun(), still_life::sphere(), still_life::disk()];
    for camera in [still_life::camera(), still_life::other_camera()] {
        check(&still_life::scene(), (&still_life::view_of(&camera), &lights));
    }
}

#[test]
fn the_colonnade_is_the_same_pixel_for_pixel() {
    let scene = Scene::builtin("colonnade").expect("a scene");
    check(&scene, (&still_life::view_of(&scene.paths[0].frames[0].camera), &scene.lights));
}

/// A floor under a roof, both wider than the map: its border crosses an umbra.
fn roofed() -> Scene {
    let mut geometry = still_life::plane(6.0, Quat::IDENTITY);
    let corners = [[-6.0, 1.0, -6.0], [-6.0, 1.0, 6.0], [6.0, 1.0, 6.0], [6.0, 1.0, -6.0]];
    still_life::quad(&mut geometry, corners.map(Vec3::from));
    still_life::of_geometry(geometry)
}

/// Along the floor to the map's border.
fn under_the_roof() -> Camera {
    Camera::look_at(Vec3::new(1.0, 0.7, 0.0), Vec3::new(3.6, 0.0, 0.0), 1.0, 0.1, 40.0)
}

#[test]
fn the_maps_border_in_an_umbra_is_the_same_pixel_for_pixel() {
    let lights = [still_life::sun()];
    check(&roofed(), (&still_life::view_of(&under_the_roof()), &lights));
}

/// Bounds that are too tight must show: each of the edits takes away one thing that they allow for.
#[test]
fn bounds_that_are_too_tight_show() {
    let plants = [
        // Texels beside the disc that a bilinear compare reads.
        ("early_bounds", "FOOTPRINT_TEXELS: f32 = 1.5", "FOOTPRINT_TEXELS: f32 = 0.0"),
        // Where the map ends.
        ("early_bounds", "bounds.inside && ", ""),
        // A texel of the pyramid, and a bound.
        ("map_bounds", "x <= end.x", "x < max(end.x, first.x + 1)"),
        ("min_max_level", "min(range.x, pair.x)", "min(range.x, pair.y + 0.01)"),
    ];
    let places = [(still_life::scene(), still_life::camera()), (roofed(), under_the_roof())];
    let mut gpu = support::gpu();
    for (fragment, from, to) in plants {
        let mut apart = 0;
        for (scene, camera) in &places {
            let mut renderer = Renderer::new(&mut gpu, scene, MAPS[0]).expect("fits");
            for calibration in Calibration::ALL {
                let edited = with_edit(variant_id("chss-minmax", calibration), Edit { fragment, from, to });
                let from = (&still_life::view_of(camera), &still_life::sun());
                apart += differing(&mut renderer, edited, from).0;
            }
        }
        assert!(apart > 0, "{fragment}: {from} was not noticed");
    }
}
