mod columns;
mod near_the_floor;
mod room;
mod shapes;

use super::*;
use crate::model::Object;
use crate::rays::Soup;
use crate::{Scene, builtin_names};
use glam::Vec3;
use std::collections::HashMap;

const ALL: [Generator; 10] = [
    Generator::EdgeLadder,
    Generator::Contact,
    Generator::ThinPoles,
    Generator::Grating,
    Generator::StackedBlockers,
    Generator::ObliqueFloor,
    Generator::Foliage,
    Generator::Colonnade,
    Generator::CurvedReceivers,
    Generator::PointLightRoom,
];

/// Lit by a lamp inside it, not by the suite's sun over a square floor.
const ROOM: &str = "point-light-room";

fn object<'a>(model: &'a Model, name: &str) -> &'a Object {
    model.objects.iter().find(|object| object.name == name).expect(name)
}

fn corners(object: &Object) -> impl Iterator<Item = [DVec3; 3]> {
    object.triangles.iter().map(|t| t.map(|v| object.positions[v as usize]))
}

fn bounds(object: &Object) -> (DVec3, DVec3) {
    let first = object.positions[0];
    object.positions.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p)))
}

/// Unit vectors: the horizontal and vertical axis of a shadow map, and towards the sun.
fn map_axes(azimuth_degrees: f64) -> [DVec3; 3] {
    let (z, x) = azimuth_degrees.to_radians().sin_cos();
    let (up, level) = SUN_ELEVATION_DEGREES.to_radians().sin_cos();
    let sun = DVec3::new(level * x, up, level * z);
    let right = DVec3::Y.cross(sun).normalize();
    [right, sun.cross(right), sun]
}

/// Where the suite's sun casts a point's shadow on a level plane.
fn shadow_on(point: DVec3, height: f64) -> DVec3 {
    let [_, _, sun] = map_axes(SUN_AZIMUTH_DEGREES);
    point - sun * ((point.y - height) / sun.y)
}

/// Rounding of f64 at some 10 m, over a few operations.
const ROUNDING: f64 = 1e-12;

#[test]
fn every_solid_is_closed_and_faces_outwards() {
    for object in ALL.into_iter().flat_map(|generator| generator.model().objects) {
        // Cloth and leaves are sheets without a thickness.
        if object.name.starts_with("drape") || object.name.starts_with("leaf") {
            continue;
        }
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for &[a, b, c] in &object.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
                assert_ne!(from, to, "{}", object.name);
            }
        }
        assert!(edges.values().all(|&balance| balance == 0), "'{}' has a hole", object.name);
        assert_eq!(edges.len() * 2, object.triangles.len() * 3, "'{}': two triangles an edge", object.name);
        let volume: f64 = corners(&object).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
        assert!(volume > 0.0, "'{}' is inside out: {volume}", object.name);
    }
}

#[test]
fn nothing_is_degenerate_or_suspicious() {
    for name in builtin_names() {
        let scene = Scene::builtin(name).expect("a scene");
        let notes: &[&str] =
            if name == ROOM { &["2 lights: number 1 is scored; --light chooses"] } else { &[] };
        assert_eq!(scene.notes, notes, "{name}");
        assert_eq!(scene.origin, DVec3::ZERO);
        assert!(
            scene.materials.iter().all(|m| m.albedo.min_element() > 0.05 && m.albedo.max_element() < 0.9)
        );
        let (lo, hi) = scene.geometry.bounds();
        // Half the floor along x and z, and where the highest thing ends.
        let ([x, z], top) = match name {
            ROOM => ([3.2, 2.2], 3.2..3.21),
            "oblique-floor" => ([30.0, 30.0], 4.0..4.01),
            "contact" => ([10.0, 10.0], 2.0..2.1),
            "grating" => ([10.0, 10.0], 0.5..0.53),
            _ => ([10.0, 10.0], 4.0..11.0),
        };
        assert!((lo - Vec3::new(-x, -0.2, -z)).length() < 1e-6, "{name}: {lo}");
        assert!(top.contains(&hi.y), "{name}: {hi}");
    }
}

/// With room for the penumbra of the highest blocker, over the whole light sweep. The floor of D6
/// is as wide as the suite asks for: only its empty corners lie outside. The map of D10 is a
/// perspective one, which has its own test.
#[test]
fn everything_lies_inside_the_shadow_map() {
    for name in builtin_names() {
        if name == ROOM {
            continue;
        }
        let scene = Scene::builtin(name).expect("a scene");
        let region = scene.shadow_region;
        let (half, is_wide) = (f64::from(region.width_world) / 2.0, name == "oblique-floor");
        assert_eq!(region.width_world, if is_wide { 80.0 } else { 30.0 });
        for azimuth in [30.0, 36.0, 42.0] {
            let [right, up, _] = map_axes(azimuth);
            for &position in scene.geometry.positions.iter().filter(|p| !is_wide || p.y > 0.0) {
                let at = (position - region.centre).as_dvec3();
                let far = at.dot(right).abs().max(at.dot(up).abs());
                assert!(far < half - 0.5, "{name}: {position} lies {far} m from the middle of the map");
            }
        }
    }
}

#[test]
fn every_path_sees_the_scene() {
    for name in builtin_names() {
        let scene = Scene::builtin(name).expect("a scene");
        let soup = Soup::from(&scene.geometry);
        for path in &scene.paths {
            for frame in [0, path.frames.len() - 1] {
                let camera = path.frames[frame].camera;
                let tan = (0.5 * camera.yfov_radians).tan();
                let grid = (0..9).flat_map(|y| (0..16).map(move |x| (x as f32 + 0.5, y as f32 + 0.5)));
                let ray = |(x, y): (f32, f32)| {
                    let at = Vec3::new((x / 8.0 - 1.0) * tan * 16.0 / 9.0, (1.0 - y / 4.5) * tan, -1.0);
                    camera.world_from_camera.transform_vector3(at).normalize().as_dvec3()
                };
                let hits: Vec<f64> =
                    grid.filter_map(|p| Some(soup.cast(camera.eye().as_dvec3(), ray(p))?.distance)).collect();
                // From 40 m the same floor is that much smaller: 3 % are 1700 pixels of 320 x 180.
                let enough = if path.name == "P1-far" { 4 } else { 72 };
                let count = hits.len();
                assert!(count >= enough, "{name} {} frame {frame}: {count} of 144 rays hit", path.name);
                let nearest = hits.iter().copied().fold(f64::INFINITY, f64::min);
                assert!(nearest > 0.3, "{name} {} frame {frame}: {nearest} m before the camera", path.name);
            }
        }
    }
}

/// The line along which P1-far and P1 move is free between them: neither looks through a wall.
#[test]
fn far_paths_start_in_the_open() {
    for name in ["edge-ladder", "oblique-floor", "colonnade"] {
        let scene = Scene::builtin(name).expect("a scene");
        let soup = Soup::from(&scene.geometry);
        let [far, near] =
            ["P1-far", "P1"].map(|path| scene.path(path).expect(path).frames[0].camera.eye().as_dvec3());
        assert!(!soup.is_inside_solid(far), "{name}");
        // From 40 m to 12 m from the target; three decimals of a file, in each coordinate.
        assert!((far.distance(near) - 28.0).abs() < 2e-3, "{name}: {}", far.distance(near));
        let hit = soup.cast(far, near - far);
        assert!(hit.is_none_or(|hit| hit.distance > 1.0), "{name}: {hit:?}");
    }
}

#[test]
fn ladder_plates_hang_and_turn_as_they_should() {
    let model = Generator::EdgeLadder.model();
    assert_eq!(model.objects.len(), 16);
    let [right, up, _] = map_axes(SUN_AZIMUTH_DEGREES);
    for height in edge_ladder::HEIGHTS {
        for degrees in edge_ladder::EDGE_DEGREES {
            let plate = object(&model, &format!("plate {height} m, {degrees} degrees"));
            assert!((bounds(plate).0.y - height).abs() < ROUNDING);
            // An edge of the lower face, along the plate's own x.
            let edge = plate.positions[1] - plate.positions[0];
            assert!((edge.length() - 2.0).abs() < ROUNDING && edge.y == 0.0);
            let in_map = edge.dot(up).atan2(edge.dot(right)).to_degrees().abs();
            let angle = in_map.min(180.0 - in_map);
            // atan2 and back, in degrees.
            assert!((angle - degrees).abs() < 1e-10, "{angle} instead of {degrees}");
        }
    }
}

/// Shadows with their penumbrae (at most half a metre at 10 m) do not touch.
#[test]
fn ladder_shadows_lie_apart() {
    let model = Generator::EdgeLadder.model();
    let plates = &model.objects[1..];
    let centre = |plate: &Object| shadow_on(plate.positions.iter().sum::<DVec3>() / 8.0, 0.0);
    for (i, a) in plates.iter().enumerate() {
        for b in &plates[..i] {
            let apart = (centre(a) - centre(b)).abs();
            // Half diagonals of both, and half of the widest penumbra, stretched by 1 / sin(50).
            assert!(apart.x.max(apart.z) > 2.0 * 2f64.sqrt() + 0.6, "{} and {}", a.name, b.name);
        }
    }
}

/// All corners of a cylinder, but for the middles of its ends, lie on its radius.
fn assert_radius(pole: &Object, radius: f64) {
    let (from, to) = (pole.positions[0], pole.positions[1]);
    let axis = (to - from).normalize();
    for &corner in &pole.positions[2..] {
        let off = (corner - from).reject_from(axis).length();
        assert!((off - radius).abs() < ROUNDING, "'{}': {off} instead of {radius}", pole.name);
    }
}

#[test]
fn poles_have_their_radii_and_heights() {
    let model = Generator::ThinPoles.model();
    for (radius, ..) in thin_poles::LEVEL {
        for along in ["x", "z"] {
            let pole = object(&model, &format!("level pole {radius} m along {along}"));
            assert_radius(pole, radius);
            let height = pole.positions[0].y;
            assert!(
                (height - thin_poles::LEVEL_HEIGHT).abs() <= 0.1 + ROUNDING && height == pole.positions[1].y
            );
        }
    }
    for (k, (radius, _)) in thin_poles::UPRIGHT.into_iter().enumerate() {
        let pole = object(&model, &format!("upright pole {k} {radius} m"));
        assert_radius(pole, radius);
        assert_eq!((bounds(pole).0.y, bounds(pole).1.y), (0.0, thin_poles::UPRIGHT_HEIGHT));
    }
    let cable = object(&model, "cable");
    assert_radius(cable, thin_poles::CABLE_RADIUS);
    assert_eq!(cable.positions[0].y, thin_poles::CABLE_HEIGHT);
}

/// Seen from the sun, the plates overlap by half, and every stair lies below both over its middle.
#[test]
fn the_leak_rig_has_its_ratios() {
    let model = Generator::StackedBlockers.model();
    let [lower, upper] = ["lower plate", "upper plate"].map(|name| bounds(object(&model, name)));
    let tops = [lower.1.y, upper.1.y];
    assert_eq!(tops, [stacked_blockers::LOWER_TOP, stacked_blockers::UPPER_TOP]);
    let middle = |(lo, hi): (DVec3, DVec3)| (0.5 * (lo + hi)).with_y(hi.y);
    let seen = shadow_on(middle(upper), tops[0]) - middle(lower);
    let width = lower.1.z - lower.0.z;
    assert!((seen.z.abs() - 0.5 * width).abs() < ROUNDING && seen.x.abs() < ROUNDING, "{seen}");
    let ratios = [1.1, 1.25, 1.5, 2.0, 3.0];
    for (k, (below, ratio)) in stacked_blockers::STAIRS_BELOW.into_iter().zip(ratios).enumerate() {
        let receiver = tops[0] - below;
        let t = (tops[1] - receiver) / (tops[1] - tops[0]);
        assert!((t - ratio).abs() < ROUNDING);
        // The stair's middle, seen along the sun on the lower plate's plane, lies under the plate.
        let stair = model.objects.iter().find(|object| object.name == format!("stair {below} m below"));
        assert_eq!(stair.is_none(), k == 4, "the last stair is the floor");
        if let Some(stair) = stair {
            assert!((bounds(stair).1.y - receiver).abs() < ROUNDING);
            let ends = [bounds(stair).0.x, bounds(stair).1.x].map(|x| x - shadow_on(DVec3::Y * below, 0.0).x);
            assert!(ends[0] > lower.0.x && ends[1] < lower.1.x, "stair {k} reaches out of the shadow");
        }
    }
}

#[test]
fn bars_cross_patches_of_light() {
    let model = Generator::StackedBlockers.model();
    for degrees in [0, 45, 90] {
        let bar = object(&model, &format!("bar at {degrees} degrees"));
        assert!((bounds(bar).0.y - stacked_blockers::BAR_HEIGHT).abs() < ROUNDING);
        let sides = ["+x", "-x", "+z", "-z"]
            .map(|side| bounds(object(&model, &format!("plate over the bar at {degrees} degrees, {side}"))));
        assert!((sides[0].0.y - stacked_blockers::PLATE_HEIGHT).abs() < ROUNDING);
        assert!(
            (sides[0].0.x - sides[1].1.x - 1.0).abs() < ROUNDING
                && (sides[2].0.z - sides[3].1.z - 1.0).abs() < ROUNDING
        );
        assert!((sides[0].1.x - sides[1].0.x - 3.0).abs() < ROUNDING);
        let hole = DVec3::new(sides[1].1.x + 0.5, sides[0].0.y, sides[3].1.z + 0.5);
        let middle = bar.positions.iter().sum::<DVec3>() / 8.0;
        let apart = shadow_on(hole, 0.0) - shadow_on(middle.with_y(bounds(bar).0.y), 0.0);
        assert!(apart.length() < ROUNDING, "{apart}");
    }
}
