//! The crate as its users see it: loading, recentring, notes, hashes.

use crate::{AreaLight, LightSpec, Motion, Scene, SceneError, SceneFile, builtin_names};
use glam::{DVec3, Vec3};
use std::path::Path;

const LADDER: &str = include_str!("../../../scenes/edge-ladder/scene.toml");
const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

fn file() -> SceneFile {
    SceneFile::parse(LADDER, Path::new("scene.toml")).expect("valid")
}

fn build(file: &SceneFile) -> Scene {
    Scene::from_file("test", file, Path::new("scene.toml")).expect("a scene")
}

/// Moves a file's light and paths along with its geometry.
fn moved(by: [f64; 3]) -> SceneFile {
    let mut file = file();
    let shift = |place: &mut [f64; 3]| place.iter_mut().zip(by).for_each(|(p, d)| *p += d);
    file.geometry.translate = by;
    file.lights[0] = LightSpec::Sphere { centre: [3.0, 9.0, 1.0], radius_world: 0.3 };
    file.paths.truncate(2);
    for path in &mut file.paths {
        match &mut path.motion {
            Motion::Still { eye, target } | Motion::Dolly { eye, target, .. } => {
                shift(eye);
                shift(target);
            }
            _ => panic!("P0 stands, P1 is a dolly"),
        }
    }
    let Some(region) = &mut file.shadow_region else { panic!("a region") };
    shift(&mut region.centre);
    let LightSpec::Sphere { centre, .. } = &mut file.lights[0] else { panic!("a sphere") };
    shift(centre);
    file
}

#[test]
fn a_scene_far_away_is_recentred_with_all_that_belongs_to_it() {
    let near = build(&moved([0.0; 3]));
    for by in [[1000.0, 0.0, 2000.0], [-3e5, 20.0, 1e5]] {
        let far = build(&moved(by));
        assert_eq!(near.origin, DVec3::ZERO);
        let back = (DVec3::from(by) - far.origin).as_vec3();
        assert!(far.origin.length() > 1000.0 && back.length() < 10.0, "{}", far.origin);
        assert!(far.notes.iter().any(|note| note.starts_with("recentred")), "{:?}", far.notes);
        // Places are rounded once, relative to the new origin: f32 steps by 1e-6 at 16 m, on each of
        // three axes, in both scenes. f64 at 300 km steps by 6e-11. Without recentring: 3 cm.
        let close = |a: Vec3, b: Vec3| assert!((a - (b + back)).length() < 4e-6, "{a} is not {b} + {back}");
        for (a, b) in far.geometry.positions.iter().zip(&near.geometry.positions) {
            close(*a, *b);
        }
        close(far.lights[0].centre().expect("a place"), near.lights[0].centre().expect("a place"));
        close(far.shadow_region.centre, near.shadow_region.centre);
        for (a, b) in far.paths.iter().zip(&near.paths) {
            close(a.frames[100].camera.eye(), b.frames[100].camera.eye());
        }
    }
}

#[test]
fn a_large_scene_round_its_origin_stays_where_it_is() {
    let mut file = moved([90.0, 0.0, 0.0]);
    file.geometry.scale = 1.0;
    assert_eq!(build(&file).origin, DVec3::ZERO, "90 m is not far");
    let mut file = moved([150.0, 0.0, 0.0]);
    file.geometry.scale = 100.0;
    assert_eq!(build(&file).origin, DVec3::ZERO, "150 m is little for a scene of 2 km");
}

/// tobj reads f32: a kilometre away a vertex is rounded to 2^-15 m, by at most half of that.
#[test]
fn an_obj_a_kilometre_away_keeps_a_tenth_of_a_millimetre() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("far.obj");
    let text = "v 1000.1234 0 0\nv 1001.1234 0.0001 0\nv 1000.1234 1 0\nf 1 2 3\n";
    std::fs::write(&path, text).expect("written");
    let scene = Scene::load(&path).expect("a scene");
    assert_eq!(scene.origin, DVec3::new(1001.0, 1.0, 0.0));
    let first = scene.geometry.corners(0)[0].as_dvec3() + scene.origin;
    assert!((first.x - 1000.1234).abs() < 3.1e-5, "{first}");
}

#[test]
fn z_up_and_centimetres_become_y_up_and_metres() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a.obj"), "v 0 0 0\nv 100 0 0\nv 0 200 300\nf 1 2 3\n")
        .expect("written");
    let tail = LADDER.split_once("generator = \"edge-ladder\"").expect("a generator").1;
    let head = "title = \"t\"\n[geometry]\nfiles = [\"a.obj\", \"a.obj\"]\nscale = 0.01\nup = \"z\"\ntranslate = [0, 1, 0]\n";
    std::fs::write(folder.path().join("scene.toml"), format!("{head}{tail}")).expect("written");
    let scene = Scene::load(folder.path()).expect("a scene");
    assert_eq!(scene.geometry.triangles.len(), 2, "files are joined");
    // One rounding of each coordinate to f32.
    let [a, b, c] = scene.geometry.corners(1);
    assert!(a.distance(Vec3::Y) < 1e-6 && b.distance(Vec3::new(1.0, 1.0, 0.0)) < 1e-6, "{a} {b}");
    assert!(c.distance(Vec3::new(0.0, 4.0, -2.0)) < 1e-6, "{c}");
}

#[test]
fn loads_folders_files_and_models() {
    let folder = tempfile::tempdir().expect("a folder");
    let hall = folder.path().join("hall");
    std::fs::create_dir(&hall).expect("made");
    std::fs::write(hall.join("scene.toml"), LADDER).expect("written");
    std::fs::write(hall.join("other.toml"), LADDER).expect("written");
    std::fs::write(hall.join("Model.OBJ"), TRIANGLE).expect("written");
    let name = |path: &Path| Scene::load(path).expect("a scene").name;
    assert_eq!(name(&hall), "hall");
    assert_eq!(name(&hall.join("scene.toml")), "hall");
    assert_eq!(name(&hall.join("other.toml")), "other");
    assert_eq!(name(&hall.join("Model.OBJ")), "Model");
}

#[test]
fn what_is_missing_or_no_scene_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let error = |name: &str| Scene::load(&folder.path().join(name)).expect_err("missing");
    assert!(matches!(error("nowhere.toml"), SceneError::Read { .. }));
    assert!(matches!(error("nowhere.obj"), SceneError::Read { .. }));
    assert!(matches!(error("nowhere.glb"), SceneError::Read { .. }));
    assert!(matches!(error("picture.png"), SceneError::NotAScene { .. }));
    assert!(error("").to_string().contains("scene.toml"), "a folder without a scene");
    let error = Scene::builtin("colonade").expect_err("a typing mistake").to_string();
    assert_eq!(error, "there is no scene called 'colonade'; did you mean 'colonnade'?");
    let scene = Scene::builtin("colonnade").expect("a scene");
    assert_eq!(
        scene.path("p1").expect_err("lower case").to_string(),
        "there is no path called 'p1'; did you mean 'P1'?"
    );
}

/// The file that is made for a bare model gives the same scene when it is read back.
#[test]
fn a_bare_model_gets_a_file_that_reproduces_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("small.obj");
    std::fs::write(&path, TRIANGLE).expect("written");
    let (scene, file) = Scene::load_with_file(&path).expect("a scene");
    assert_eq!(file, SceneFile::for_model(&path).expect("a file"));
    std::fs::write(folder.path().join("scene.toml"), file.to_toml()).expect("written");
    let again = Scene::load(folder.path()).expect("a scene");
    assert_eq!(again.geometry, scene.geometry);
    assert_eq!(again.paths, scene.paths);
    assert_eq!((again.lights, again.shadow_region), (scene.lights.clone(), scene.shadow_region));
    let AreaLight::Sun { direction_to_light, angular_diameter_radians } = scene.lights[0] else {
        panic!("a sun")
    };
    assert!((direction_to_light.y - 50f32.to_radians().sin()).abs() < 1e-7);
    assert_eq!(angular_diameter_radians, 2f32.to_radians());
    let names: Vec<&str> = scene.paths.iter().map(|path| path.name.as_str()).collect();
    assert_eq!(names, ["P1", "P4"]);
    assert!(scene.shadow_region.width_world >= 2f32.sqrt(), "the diagonal of the bounds");
}

/// The court of D8, given as a bare model: the camera finds its way into it.
#[test]
fn a_court_is_seen_from_inside_its_bounds() {
    let scene = Scene::builtin("colonnade").expect("a scene");
    let place = |p: &Vec3| format!("v {} {} {}\n", p.x, p.y, p.z);
    let face = |t: &[u32; 3]| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    let text: String = scene.geometry.positions.iter().map(place).collect();
    let faces: String = scene.geometry.triangles.iter().map(face).collect();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("court.obj");
    std::fs::write(&path, text + &faces).expect("written");
    let bare = Scene::load(&path).expect("a scene");
    let (lo, hi) = bare.geometry.bounds();
    for path in &bare.paths {
        for frame in &path.frames {
            let eye = frame.camera.eye();
            assert!(eye.cmpgt(lo).all() && eye.cmplt(hi).all() && eye.y < 3.0, "{}: {eye}", path.name);
        }
    }
    assert_eq!(bare.notes, ["1 objects have no known material: grey 0.5"]);
}

#[test]
fn lights_beyond_the_first_are_noted() {
    let mut file = file();
    assert_eq!(build(&file).notes, [""; 0]);
    let sphere = |x: f64| LightSpec::Sphere { centre: [x, 9.0, 2.0], radius_world: 0.1 };
    file.lights.push(sphere(1.0));
    assert_eq!(build(&file).notes, ["2 lights: number 1 is scored; --light chooses"]);
    file.lights.push(sphere(2.0));
    assert_eq!(build(&file).notes, ["3 lights: number 1 is scored; --light chooses"]);
}

#[test]
fn suspicious_lights_and_cameras_are_noted() {
    let noted = |light: LightSpec, expected: &str| {
        let mut file = file();
        file.lights.push(light);
        let notes = build(&file).notes;
        assert!(notes.iter().any(|note| note == expected), "{notes:?}");
    };
    let sun = LightSpec::Sun {
        angular_diameter_degrees: 1.0,
        elevation_degrees: None,
        azimuth_degrees: None,
        direction_to_light: Some([0.3, -1.0, 0.0]),
    };
    noted(sun, "light 2 stands below the horizon: it reaches surfaces only from below");
    let sphere = |y: f64| LightSpec::Sphere { centre: [1.0, y, 2.0], radius_world: 0.1 };
    noted(sphere(-0.1), "light 2 lies inside a solid");
    noted(sphere(-3.0), "light 2 lies below every surface: it reaches them only from below");
    let mut file = file();
    file.paths[0].motion = Motion::Still { eye: [1.0, -0.1, 2.0], target: [0.0, -0.1, 0.0] };
    assert_eq!(build(&file).notes, ["path 'P0' starts inside a solid"]);
}

#[test]
fn the_hash_follows_what_truth_depends_on() {
    let scene = Scene::builtin("edge-ladder").expect("a scene");
    let hash = scene.content_hash();
    let mut same = scene.clone();
    same.name = "other".to_owned();
    same.materials[0].name = "other".to_owned();
    same.paths.truncate(1);
    same.notes.push("noted".to_owned());
    assert_eq!(same.content_hash(), hash);
    let changes: [fn(&mut Scene); 5] = [
        |scene| scene.geometry.positions[5].x = scene.geometry.positions[5].x.next_up(),
        |scene| scene.geometry.triangles.swap(0, 1),
        |scene| scene.geometry.material[3] += 1,
        |scene| scene.materials[0].albedo.z += 0.1,
        |scene| scene.lights.push(scene.lights[0]),
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let mut other = scene.clone();
        change(&mut other);
        assert_ne!(other.content_hash(), hash, "change {k}");
    }
    let hashes: std::collections::HashSet<[u8; 32]> =
        builtin_names().map(|name| Scene::builtin(name).expect("a scene").content_hash()).collect();
    assert_eq!(hashes.len(), builtin_names().len());
}
