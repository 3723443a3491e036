//! D6 and D8: columns, drapes, and poles high above them.

use super::*;
use crate::AreaLight;

#[test]
fn a_hundred_columns_stand_five_metres_apart() {
    let model = Generator::ObliqueFloor.model();
    let named = |part: &str| model.objects.iter().filter(|o| o.name.starts_with(part)).collect::<Vec<_>>();
    let (columns, capitals) = (named("column"), named("capital"));
    assert_eq!((columns.len(), capitals.len()), (100, 50));
    for column in &columns {
        assert_radius(column, oblique_floor::RADIUS);
    }
    let apart = columns[1].positions[0] - columns[0].positions[0];
    assert_eq!(apart, DVec3::Z * oblique_floor::PITCH);
    assert!(capitals.iter().all(|capital| bounds(capital).1.y == oblique_floor::HEIGHT));
}

#[test]
fn drapes_hang_five_centimetres_off_a_wall_in_the_sun() {
    let model = Generator::Colonnade.model();
    let wall = bounds(object(&model, "arcade wall")).1.x;
    let drapes: Vec<&Object> = model.objects.iter().filter(|o| o.name.starts_with("drape")).collect();
    assert_eq!(drapes.len(), 7);
    for drape in drapes {
        let gaps: Vec<f64> = drape.positions.iter().map(|p| p.x - wall).collect();
        let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
        assert!(gaps.iter().all(|&gap| gap > 0.0199 && gap < 0.0801), "folds of 3 cm");
        // Five whole folds, sampled evenly but for the doubled end.
        assert!((mean - 0.05).abs() < 1e-3, "{mean}");
    }
    let columns = model.objects.iter().filter(|o| o.name.ends_with("shaft")).count();
    assert_eq!(columns, 16);
}

/// On the court's floor, and on the sunlit wall with its drapes, before the camera of P0.
#[test]
fn shadows_of_high_poles_are_in_view() {
    let scene = Scene::builtin("colonnade").expect("a scene");
    let soup = Soup::from(&scene.geometry);
    let AreaLight::Sun { direction_to_light, .. } = scene.lights[0] else { panic!("a sun") };
    let camera = scene.path("P0").expect("P0").frames[0].camera;
    let in_view = |point: DVec3| {
        let clip =
            camera.clip_from_camera(16.0 / 9.0) * camera.camera_from_world() * point.as_vec3().extend(1.0);
        clip.w > 0.0 && clip.x.abs() < clip.w && clip.y.abs() < clip.w
    };
    let poles = colonnade::POLES.map(|(z, radius)| (0..9).map(move |k| (k as f64 * 0.75 - 3.0, z, radius)));
    let mut on_wall = 0;
    let mut on_floor = 0;
    for (x, z, radius) in poles.into_iter().flatten() {
        let below = DVec3::new(x, colonnade::POLE_HEIGHT, z) - direction_to_light.as_dvec3() * (2.0 * radius);
        let Some(hit) = soup.cast(below, -direction_to_light.as_dvec3()) else { continue };
        let shadow = below - direction_to_light.as_dvec3() * hit.distance;
        on_wall += usize::from(in_view(shadow) && (shadow.x + 3.4).abs() < 0.1);
        on_floor += usize::from(in_view(shadow) && shadow.y.abs() < 1e-3);
    }
    assert!(on_wall >= 8 && on_floor >= 8, "{on_wall} on wall and drapes, {on_floor} on the floor");
}
