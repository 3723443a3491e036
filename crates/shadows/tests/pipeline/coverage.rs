//! Variance shadow maps where theory calls them exact: one occluder before a receiver, both parallel
//! to the map. The bound is then the covered share of the kernel's square.

use crate::support::{self, still_life, variant_id};
use glam::{Quat, Vec3};
use umbrage_frame::Anchors;
use umbrage_scene::{AreaLight, Scene};
use umbrage_shadows::{Calibration, Renderer, Seeding};

/// Straight above; tangent of the angular radius, 0.05.
fn overhead() -> AreaLight {
    let angular_diameter_radians = 2.0 * 0.05f32.atan();
    AreaLight::Sun { direction_to_light: Vec3::Y, angular_diameter_radians }
}

/// A floor, and a plate one metre above it that covers all of x > 0.
fn half_covered() -> Scene {
    let mut geometry = still_life::plane(8.0, Quat::IDENTITY);
    let corners = [[0.0, 1.0, -8.0], [0.0, 1.0, 8.0], [8.0, 1.0, 8.0], [8.0, 1.0, -8.0]];
    still_life::quad(&mut geometry, corners.map(Vec3::from));
    still_life::of_geometry(geometry)
}

/// Places on the floor across the plate's edge, metres.
fn places() -> Vec<f32> {
    (-40..=40).map(|k| 0.002 * k as f32 + 0.0007).collect()
}

fn lit(name: &str) -> Vec<f32> {
    let (scene, light, mut gpu) = (half_covered(), overhead(), support::gpu());
    let view = still_life::view_of(&still_life::camera());
    // 500 texels of 12 mm: the edge runs between two.
    let mut renderer = Renderer::new(&mut gpu, &scene, 500).expect("fits");
    let position: Vec<_> = places().into_iter().map(|x| Vec3::new(x, 0.0, 0.0)).collect();
    let (pixel, normal) = (vec![0; position.len()], vec![Vec3::Y; position.len()]);
    renderer.set_anchors(&Anchors { view, pixel, position, normal }).expect("fits");
    let variant = variant_id(name, Calibration::LightMatched);
    let shaded = renderer.shade_anchors(variant, (&view, &light), (Seeding::Frozen, [0, 0]));
    shaded.expect("runs").values
}

/// The bias, 1 mm of a gap of 1 m, counts twice in a square: 0.002. The least variance, 1e-8 of the
/// squared far plane's distance of 6.5 m, and 22 bits of the table add less than 1e-4. A kernel off by
/// a tenth of a texel, 1.2 mm of 100 mm, would show.
const TOLERANCE: f32 = 0.004;

fn check(name: &str, radius: f32) {
    for (x, lit) in places().into_iter().zip(lit(name)) {
        let covered = (0.5 + 0.5 * x / radius).clamp(0.0, 1.0);
        // A search in which less than a hundredth blocks finds nothing.
        let tolerance = if covered < 0.02 { 0.02 } else { TOLERANCE };
        assert!((1.0 - covered - lit).abs() <= tolerance, "{name} at {x}: {lit}, covered {covered}");
    }
}

#[test]
fn a_fixed_square_of_the_table_is_exact() {
    // The scene's reference gap is 1.1 m, but nothing is nearer the light than the plate.
    check("vsm-sat", 0.05);
}

#[test]
fn search_and_filter_by_the_table_find_the_true_cone() {
    check("vsm-search-sat", 0.05);
}
