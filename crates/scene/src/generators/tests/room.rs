//! D10: a closed room, a lamp inside a chair, and shadows that cross the faces of a cube.

use super::*;

fn lamp(scene: &Scene) -> DVec3 {
    scene.lights[0].centre().expect("a lamp").as_dvec3()
}

/// The face of a cube round the lamp on which a direction lies: its axis, and which side.
fn face(direction: DVec3) -> (usize, bool) {
    let axis = [0, 1, 2].into_iter().max_by(|&a, &b| direction[a].abs().total_cmp(&direction[b].abs()));
    let axis = axis.expect("three axes");
    (axis, direction[axis] > 0.0)
}

fn is_wall(object: &Object) -> bool {
    ["floor", "ceiling", "wall"].iter().any(|part| object.name.starts_with(part))
}

#[test]
fn the_room_is_6_by_4_by_3_metres_and_closed() {
    let model = Generator::PointLightRoom.model();
    let soup = Soup::from(&model);
    let from = DVec3::new(2.0, 1.45, 1.5);
    let inner = point_light_room::ROOM;
    assert_eq!(inner * DVec3::new(2.0, 1.0, 2.0), DVec3::new(6.0, 3.0, 4.0));
    let walls = [
        (DVec3::X, inner.x - from.x),
        (DVec3::Y, inner.y - from.y),
        (DVec3::NEG_Y, from.y),
        (DVec3::Z, inner.z - from.z),
        (DVec3::NEG_X, inner.x + from.x),
    ];
    for (direction, expected) in walls {
        let hit = soup.cast(from, direction).expect("a wall");
        assert!(hit.front && (hit.distance - expected).abs() < ROUNDING, "{direction}: {hit:?}");
    }
    // Nothing escapes, not even along edges and corners.
    for (x, y, z) in (-4..=4).flat_map(|x| (-4..=4).flat_map(move |y| (-4..=4).map(move |z| (x, y, z)))) {
        let direction = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
        assert!(direction == DVec3::ZERO || soup.cast(from, direction).is_some(), "{direction}");
    }
}

/// Above the seat, below the top of the back, between the legs; and both lamps fit.
#[test]
fn the_lamp_hangs_inside_the_chair() {
    let scene = Scene::builtin("point-light-room").expect("a scene");
    let at = lamp(&scene);
    assert!(at.y > point_light_room::SEAT_HEIGHT && at.y < point_light_room::BACK_HEIGHT);
    let radii: Vec<_> = scene.lights.iter().map(|light| light.radius_world()).collect();
    assert_eq!(radii, [Some(0.1), Some(0.3)]);
    assert_eq!(scene.lights[1].centre(), scene.lights[0].centre());
    let model = Generator::PointLightRoom.model();
    let legs: Vec<DVec3> =
        model.objects.iter().filter(|o| o.name.contains("leg")).map(|leg| leg.positions[0]).collect();
    let around = |from: DVec3, to: DVec3| (from - at).with_y(0.0).cross((to - at).with_y(0.0)).y;
    // Front +z, rear +z, rear -z, front -z: round the lamp, always the same way.
    let [front_left, rear_left, front_right, rear_right] = legs[..] else { panic!("four legs") };
    let ring = [front_left, rear_left, rear_right, front_right, front_left];
    assert!(ring.windows(2).all(|pair| around(pair[0], pair[1]) < 0.0), "the lamp is not between the legs");
    let nearest = model.objects.iter().filter(|o| !is_wall(o)).flat_map(|o| &o.positions);
    let nearest = nearest.map(|p| p.distance(at)).fold(f64::INFINITY, f64::min);
    assert!(nearest > 0.3 + 0.05, "{nearest}");
}

/// What D10 is for: parts of the chair, and their shadows, on several faces of a cube map.
#[test]
fn parts_and_shadows_cross_the_faces_of_a_cube() {
    let scene = Scene::builtin("point-light-room").expect("a scene");
    let (at, model) = (lamp(&scene), Generator::PointLightRoom.model());
    let crossing = model.objects.iter().filter(|o| !is_wall(o)).filter(|part| {
        let first = face(part.positions[0] - at);
        part.positions.iter().any(|&p| face(p - at) != first)
    });
    let crossing: Vec<&str> = crossing.map(|part| part.name.as_str()).collect();
    assert!(crossing.len() >= 8, "only {crossing:?}");
    let walls =
        Model { objects: model.objects.iter().filter(|o| is_wall(o)).cloned().collect(), ..Model::default() };
    let soup = Soup::from(&walls);
    let mut seen = [0; 4];
    for &corner in model.objects.iter().filter(|o| !is_wall(o)).flat_map(|o| &o.positions) {
        let shadow = at + (corner - at) * soup.cast(at, corner - at).expect("a closed room").distance;
        let faces = [
            shadow.y < 1e-9,
            shadow.y > 3.0 - 1e-9,
            shadow.z.abs() > 2.0 - 1e-9,
            shadow.x.abs() > 3.0 - 1e-9,
        ];
        for (count, is_on) in seen.iter_mut().zip(faces) {
            *count += usize::from(is_on);
        }
    }
    assert!(seen.iter().all(|&count| count >= 8), "floor, ceiling, walls along x, walls along z: {seen:?}");
}

/// A single map of 120 degrees straight down: all shadows of the chair on the floor lie in it, and
/// all of the floor but a strip along its short sides.
#[test]
fn one_map_covers_the_shadow_on_the_floor() {
    let scene = Scene::builtin("point-light-room").expect("a scene");
    let (at, region) = (lamp(&scene), scene.shadow_region);
    let axis = region.centre.as_dvec3() - at;
    assert_eq!(axis.normalize(), DVec3::NEG_Y);
    let half = 0.5 * f64::from(region.width_world);
    assert!((half / axis.length()).atan() < f64::to_radians(60.0), "wider than a map can be");
    assert!(half > 2.0 + at.z.abs() && half > 3.0 - at.x - 0.01, "x: {half}");
    assert!(at.x - half < -2.79, "all but 21 cm");
    let model = Generator::PointLightRoom.model();
    for &corner in model.objects.iter().filter(|o| !is_wall(o)).flat_map(|o| &o.positions) {
        let to = corner - at;
        let shadow = at + to * (-at.y / to.y);
        let is_on_floor = to.y < 0.0 && shadow.x.abs() < 2.79 && shadow.z.abs() < 2.0;
        let far = (shadow - at).with_y(0.0).abs().max_element();
        assert!(!is_on_floor || far < half, "{corner} throws its shadow {far} m from the middle");
    }
}

#[test]
fn cameras_stay_inside_the_room() {
    let scene = Scene::builtin("point-light-room").expect("a scene");
    for path in &scene.paths {
        for frame in &path.frames {
            let eye = frame.camera.eye().as_dvec3();
            let room = point_light_room::ROOM - 0.1;
            assert!(eye.x.abs() < room.x && eye.z.abs() < room.z && eye.y > 0.1 && eye.y < room.y, "{eye}");
        }
    }
}
