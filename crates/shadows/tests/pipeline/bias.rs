//! The typed biases on a tilted plane, where acne and its cure have closed forms.
//!
//! A sun stands straight above; the plane rises along the map's columns at an angle a. Within a
//! texel the plane's depth departs from that at the texel's centre by x tan a, x = -1/2 to 1/2
//! texels: without a bias every second point shadows itself. A constant c lifts all points by c, a
//! normal offset of k texels (times sin a) by k tan a texels; so the share that shadows itself is
//! 1/2 - c / (texel tan a), or 1/2 - k, and never below 0.

use crate::support::{self, still_life, variant_id};
use glam::{Mat4, Quat, Vec3};
use umbrage_frame::Anchors;
use umbrage_scene::{AreaLight, Camera, Scene, ShadowRegion};
use umbrage_shadows::{Bias, Calibration, ConstantBias, ReceiverPlane, Renderer, Seeding, VariantId};

const TILT: f32 = std::f32::consts::FRAC_PI_6;
const WIDTH: f32 = 6.0;
const TEXELS: u32 = 64;
const TEXEL_WORLD: f32 = WIDTH / TEXELS as f32;
/// Points per texel along the slope.
const STEPS: u32 = 64;
/// Texels over which the points are spread, and those of the plane's middle.
const SPAN: u32 = 16;

const NONE: Bias = Bias {
    constant: ConstantBias::World(0.0),
    normal_offset_texels: 0.0,
    receiver_plane: ReceiverPlane::Off,
};

fn sun() -> AreaLight {
    AreaLight::Sun { direction_to_light: Vec3::Y, angular_diameter_radians: 0.2 }
}

fn lamp() -> AreaLight {
    AreaLight::Sphere { centre: Vec3::new(0.1, 4.0, 0.2), radius_world: 0.2 }
}

/// How the plane lies: up from x, turned round the vertical by an azimuth.
fn turn(azimuth: f32) -> Quat {
    Quat::from_rotation_y(azimuth) * Quat::from_rotation_z(TILT)
}

/// The plane, with or without a plate over one half of it.
fn scene(azimuth: f32, plate: Option<Vec3>) -> Scene {
    let mut geometry = still_life::plane(4.0, turn(azimuth));
    if let Some(centre) = plate {
        still_life::block(&mut geometry, Vec3::new(2.0, 0.01, 9.0), Mat4::from_translation(centre));
    }
    let shadow_region = ShadowRegion { centre: Vec3::ZERO, width_world: WIDTH, reference_gap_world: 1.0 };
    Scene { shadow_region, ..still_life::of_geometry(geometry) }
}

/// Points of the plane at even steps along its slope, moved by some texels of the map; across it
/// they are spread over a texel as well.
fn points(azimuth: f32, moved_texels: f32) -> Anchors {
    let view = still_life::view_of(&Camera::look_at(Vec3::Y * 9.0, Vec3::ZERO, 0.8, 0.1, 40.0));
    let count = SPAN * STEPS;
    let point = |i: u32| {
        let along = (i as f32 + 0.5) / STEPS as f32 - 0.5 * SPAN as f32 + moved_texels;
        // The golden ratio scatters the second coordinate evenly.
        let across = (i as f32 * 0.618_034).fract() * SPAN as f32 / 4.0;
        let level = Vec3::new(along, along * TILT.tan(), across) * TEXEL_WORLD;
        Quat::from_rotation_y(azimuth) * level
    };
    Anchors {
        view,
        pixel: vec![0; count as usize],
        position: (0..count).map(point).collect(),
        normal: vec![turn(azimuth) * Vec3::Y; count as usize],
    }
}

fn shade(scene: &Scene, light: AreaLight, (name, bias): (&str, Bias), anchors: &Anchors) -> Vec<f32> {
    let variant: VariantId = variant_id(name, Calibration::LightMatched);
    let mut gpu = support::gpu();
    let mut renderer = Renderer::new(&mut gpu, scene, TEXELS).expect("fits");
    renderer.set_bias(bias);
    renderer.set_anchors(anchors).expect("fits");
    let how = (Seeding::Frozen, [0, 0]);
    renderer.shade_anchors(variant, (&anchors.view, &light), how).expect("runs").values
}

/// Share of the points that shadow themselves.
fn acne(azimuth: f32, light: AreaLight, variant: (&str, Bias)) -> f32 {
    let values = shade(&scene(azimuth, None), light, variant, &points(azimuth, 0.0));
    values.iter().filter(|&&v| v < 1.0).count() as f32 / values.len() as f32
}

/// Two of the steps of a texel: both ends of the range that shadows itself fall between steps.
const STEP_SHARE: f32 = 2.0 / STEPS as f32;

#[test]
fn a_normal_offset_of_k_texels_leaves_half_less_k_of_the_points_in_acne() {
    for k in [0.0f32, 0.125, 0.25, 0.4, 0.55, 1.0, 2.0] {
        let bias = Bias { normal_offset_texels: k.into(), ..NONE };
        let share = acne(0.0, sun(), ("hard", bias));
        let expected = (0.5 - k).max(0.0);
        assert!((share - expected).abs() <= STEP_SHARE, "k = {k}: {share}, expected {expected}");
        assert!(k < 0.5 || share == 0.0, "k = {k} leaves {share}");
    }
}

#[test]
fn a_constant_bias_leaves_half_less_its_share_of_a_texels_slope() {
    let slope = TEXEL_WORLD * TILT.tan();
    for share_of_slope in [0.1f32, 0.3, 0.55, 1.0] {
        let constant = ConstantBias::World(f64::from(share_of_slope * slope));
        let share = acne(0.0, sun(), ("hard", Bias { constant, ..NONE }));
        let expected = (0.5 - share_of_slope).max(0.0);
        assert!((share - expected).abs() <= STEP_SHARE, "{share_of_slope}: {share}, expected {expected}");
        assert!(share_of_slope < 0.5 || share == 0.0);
    }
}

#[test]
fn a_plane_across_the_texels_needs_seven_tenths_of_a_texel() {
    // Diagonally a texel's corner lies sqrt(1/2) texels from its centre.
    let with =
        |k: f64| acne(std::f32::consts::FRAC_PI_4, sun(), ("hard", Bias { normal_offset_texels: k, ..NONE }));
    assert!(with(0.0) > 0.45);
    assert!(with(0.6) > 0.0, "the corners still shadow themselves");
    assert_eq!(with(0.75), 0.0);
}

#[test]
fn a_receiver_plane_removes_all_acne_however_wide_the_kernel() {
    // What rounding alone needs: depths of 6 m, to a few ulps.
    let hair = ConstantBias::World(1e-5);
    let plane = Bias { constant: hair, receiver_plane: ReceiverPlane::On { max_slope: 20.0 }, ..NONE };
    for azimuth in [0.0, 0.5] {
        for light in [sun(), lamp()] {
            for name in ["hard", "pcf-grid-11", "pcf-vogel-16"] {
                let without = acne(azimuth, light, (name, Bias { constant: hair, ..NONE }));
                assert!(without > 0.4, "{name} {light:?}: without a plane {without}");
                assert_eq!(acne(azimuth, light, (name, plane)), 0.0, "{name} {light:?} {azimuth}");
            }
        }
    }
}

#[test]
fn a_plane_steeper_than_the_cap_is_not_followed() {
    let capped = |max_slope: f64| {
        let plane = Bias { receiver_plane: ReceiverPlane::On { max_slope }, ..NONE };
        acne(0.0, sun(), ("hard", Bias { constant: ConstantBias::World(1e-5), ..plane }))
    };
    let slope = f64::from(TILT.tan());
    assert_eq!(capped(1.01 * slope), 0.0);
    assert!(capped(0.9 * slope) > 0.4);
}

#[test]
fn a_normal_offset_of_five_quarters_removes_all_acne_under_a_lamp() {
    // The offset grows with the sine between normal and ray, the slope in the map with that between
    // normal and axis: where rays lean 11 degrees towards the normal, 0.65 of it. Diagonally
    // sqrt(1/2) / 0.65 = 1.09 texels are needed.
    for azimuth in [0.0, 0.5] {
        let with = |k: f64| acne(azimuth, lamp(), ("hard", Bias { normal_offset_texels: k, ..NONE }));
        assert!(with(0.0) > 0.4);
        assert_eq!(with(1.25), 0.0);
    }
}

#[test]
fn a_normal_offset_moves_a_shadow_by_its_foot_in_the_map() {
    // A point that rises by k texels times sin a along the normal moves k sin^2 a texels sideways:
    // down the slope, -1 texel for k = 4 and a = 30 degrees. So do all shadows, and by no more.
    let bias = Bias { constant: ConstantBias::World(0.5), normal_offset_texels: 4.0, ..NONE };
    let plate = scene(0.0, Some(Vec3::new(-1.0, 3.0, 0.0)));
    let offset = shade(&plate, sun(), ("hard", bias), &points(0.0, 0.0));
    let straight = Bias { normal_offset_texels: 0.0, ..bias };
    let moved = shade(&plate, sun(), ("hard", straight), &points(0.0, -1.0));
    let still = shade(&plate, sun(), ("hard", straight), &points(0.0, 0.0));
    assert!(offset == moved, "moved by another length than a texel");
    // One edge of the plate's shadow lies among the points: one texel of them is told otherwise.
    let told_otherwise = offset.iter().zip(&still).filter(|(a, b)| a != b).count();
    assert_eq!(told_otherwise, STEPS as usize);
}
