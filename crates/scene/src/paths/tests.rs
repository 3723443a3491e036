use crate::spec::{Interpolation, Keyframe, Motion};
use crate::{AreaLight, CameraPath, Scene, SceneError, SceneFile, builtin_names};
use glam::{DVec3, DVec4, Vec3};
use std::path::Path;

const EYE: [f64; 3] = [1.0, 3.0, 9.0];
const TARGET: [f64; 3] = [-2.0, 0.5, 0.0];

/// The edge ladder seen along one path.
fn scene(motion: Motion, frames: Option<u32>) -> Result<Scene, SceneError> {
    let builtin = include_str!("../../../../scenes/edge-ladder/scene.toml");
    let mut file = SceneFile::parse(builtin, Path::new("scene.toml"))?;
    file.paths.truncate(1);
    file.paths[0].motion = motion;
    file.paths[0].frames = frames;
    Scene::from_file("test", &file, Path::new("scene.toml"))
}

fn path(motion: Motion) -> CameraPath {
    scene(motion, None).expect("a path").paths.remove(0)
}

/// The one scene that is too small for the suite's speeds.
const ROOM: &str = "point-light-room";

fn forward(path: &CameraPath, frame: usize) -> Vec3 {
    -path.frames[frame].camera.world_from_camera.z_axis.truncate()
}

#[test]
fn a_dolly_goes_towards_its_target() {
    for name in builtin_names() {
        let scene = Scene::builtin(name).expect("a scene");
        for path in scene.paths.iter().filter(|path| path.name.starts_with("P1")) {
            assert_eq!((path.frames.len(), path.frames_per_second), (120, 60.0));
            let (first, last) = (path.frames[0].camera.eye(), path.frames[119].camera.eye());
            // Half as fast in the room: 4 m are its width.
            let metres_per_second = if name == ROOM { 1.0 } else { 2.0 };
            let gone = first.distance(last);
            // 119 steps at 60 frames a second; f32 rounding of places up to 50 m away.
            assert!((gone - 119.0 / 60.0 * metres_per_second).abs() < 1e-5, "{name}: {gone}");
            let sideways = (last - first).normalize().dot(forward(path, 0));
            assert!(sideways > 1.0 - 1e-6, "{name}: not along the view");
        }
    }
}

/// The target moves by exactly px_per_frame in a picture of the reference height.
#[test]
fn a_creep_moves_a_sixteenth_of_a_pixel_a_frame() {
    for name in builtin_names() {
        let source = SceneFile::read(
            &Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenes/{name}/scene.toml")),
        );
        let file = source.expect("a scene file");
        let spec = file.paths.iter().find(|path| path.name == "P5").expect("P5");
        let Motion::Creep { target, px_per_frame, reference_height_px, .. } = spec.motion else {
            panic!("P5 creeps")
        };
        assert_eq!((px_per_frame, reference_height_px), (0.0625, 720.0));
        let scene = Scene::builtin(name).expect("a scene");
        let path = scene.path("P5").expect("P5");
        assert_eq!(path.title, "creep, 0.0625 px a frame in a picture 720 px high", "{name}");
        let pixel = |frame: usize| {
            let camera = path.frames[frame].camera;
            let at = camera.world_from_camera.as_dmat4().inverse() * DVec3::from(target).extend(1.0);
            let scale = 0.5 * reference_height_px / (0.5 * f64::from(camera.yfov_radians)).tan();
            DVec4::new(at.x, at.y, 0.0, 0.0).truncate().truncate() * (scale / -at.z)
        };
        let start = pixel(0);
        for frame in [1, 2, 60, 119] {
            let moved = pixel(frame) - start;
            // The eye is rounded to f32: half a step of 1e-6 m (2e-6 beyond 16 m) at 60 px a metre,
            // twice, on three axes. A height of 719 px would give 1.4e-3 of the step, .01 px at the end.
            let expected = -px_per_frame * frame as f64;
            assert!((moved.x - expected).abs() < 4e-4, "{name} frame {frame}: {moved}");
            assert!(moved.y.abs() < 4e-4, "{name} frame {frame}: {moved}");
        }
    }
}

#[test]
fn sliding_views_do_not_turn() {
    let strafe = path(Motion::Strafe { eye: EYE, target: TARGET, metres_per_second: 1.5 });
    let creep =
        path(Motion::Creep { eye: EYE, target: TARGET, px_per_frame: 0.0625, reference_height_px: 720.0 });
    for path in [&strafe, &creep] {
        let rotation = |frame: usize| glam::Mat3::from_mat4(path.frames[frame].camera.world_from_camera);
        assert!((0..120).all(|frame| rotation(frame) == rotation(0)), "every bit is the same");
    }
    let gone = strafe.frames[119].camera.eye() - strafe.frames[0].camera.eye();
    // 119 steps of 25 mm; rounding of the eyes.
    assert!((gone.length() - 2.975).abs() < 3e-6 && gone.dot(forward(&strafe, 0)).abs() < 3e-6, "{gone}");
    let right = strafe.frames[0].camera.world_from_camera.x_axis.truncate();
    assert!(gone.dot(right) > 0.0, "to the right");
}

#[test]
fn an_orbit_keeps_distance_and_pitch() {
    let orbit = path(Motion::Orbit {
        target: TARGET,
        radius_world: 8.0,
        pitch_degrees: -25.0,
        azimuth_degrees: 90.0,
        degrees_per_second: 15.0,
    });
    let target = DVec3::from(TARGET).as_vec3();
    let from_target = |frame: usize| orbit.frames[frame].camera.eye() - target;
    for frame in 0..120 {
        // f32 rounding of the eye.
        assert!((from_target(frame).length() - 8.0).abs() < 2e-6);
        let pitch = forward(&orbit, frame).y.asin().to_degrees();
        // asin of an f32: 1e-7 / cos(25 degrees), in degrees.
        assert!((pitch + 25.0).abs() < 2e-5, "{pitch}");
    }
    let azimuth = |frame: usize| from_target(frame).z.atan2(from_target(frame).x).to_degrees();
    assert!((azimuth(0) - 90.0).abs() < 1e-4 && (azimuth(60) - 105.0).abs() < 1e-4, "towards -x");
}

#[test]
fn an_oblique_flight_ends_low_and_level() {
    for name in builtin_names() {
        let scene = Scene::builtin(name).expect("a scene");
        let path = scene.path("P4").expect("P4");
        let (first, last) = (path.frames[0].camera.eye(), path.frames[119].camera.eye());
        assert_eq!((first.y, last.y), (1.6, 0.6), "{name}");
        let pitch = |frame: usize| forward(path, frame).y.asin().to_degrees();
        // asin of an f32, in degrees.
        assert!((pitch(0) + 8.0).abs() < 2e-5 && (pitch(119) + 3.0).abs() < 2e-5, "{name}");
        let level = (last - first).with_y(0.0);
        // 119 steps of 50 mm (in the room, which is no longer than 6 m, a third of that); rounding of
        // places up to 20 m away.
        let expected = if name == ROOM { 5.95 / 3.0 } else { 5.95 };
        assert!((level.length() - expected).abs() < 4e-6, "{name}: {level}");
        assert!(level.normalize().dot(forward(path, 0).with_y(0.0).normalize()) > 1.0 - 1e-6, "{name}");
    }
}

#[test]
fn a_light_sweep_turns_only_the_light() {
    let scene = Scene::builtin("colonnade").expect("a scene");
    let path = scene.path("P6").expect("P6");
    assert!(path.light_moves() && !scene.path("P1").expect("P1").light_moves());
    let direction = |frame: usize| path.frames[frame].light.direction_from(Vec3::ZERO);
    let azimuth = |frame: usize| direction(frame).z.atan2(direction(frame).x).to_degrees();
    for frame in [0, 1, 119] {
        let expected = 30.0 + 0.1 * frame as f32;
        // f32 rounding of a unit vector, in degrees.
        assert!((azimuth(frame) - expected).abs() < 2e-5, "{}", azimuth(frame));
        assert!((direction(frame).y - 50f32.to_radians().sin()).abs() < 2e-7);
    }
    assert!(path.frames.iter().all(|frame| frame.camera == path.frames[0].camera));
    let slow = &scene.path("P6-slow").expect("P6-slow").frames;
    let turned = slow[119].light.direction_from(Vec3::ZERO);
    // A tenth as fast, to the same rounding.
    assert!((turned.z.atan2(turned.x).to_degrees() - 31.19).abs() < 2e-5);
    assert_eq!(slow[0], path.frames[0]);
}

#[test]
fn a_local_light_turns_about_the_target() {
    let source = include_str!("../../../../scenes/edge-ladder/scene.toml");
    let mut file = SceneFile::parse(source, Path::new("scene.toml")).expect("valid");
    file.paths.truncate(1);
    file.paths[0].motion = Motion::LightSweep { eye: EYE, target: TARGET, degrees_per_frame: 1.0 };
    file.lights[0] = crate::LightSpec::Sphere { centre: [1.0, 4.0, 0.0], radius_world: 0.2 };
    let scene = Scene::from_file("test", &file, Path::new("scene.toml")).expect("a scene");
    let AreaLight::Sphere { centre, .. } = scene.paths[0].frames[90].light else { panic!("a sphere") };
    // 3 m along x from the target become 3 m along z; f32 rounding.
    assert!(centre.distance(Vec3::new(-2.0, 4.0, 3.0)) < 1e-6, "{centre}");
}

fn keyframes(interpolation: Interpolation) -> Motion {
    let key = |time_secs: f64, x: f64| Keyframe { time_secs, eye: [x, 2.0, 9.0], target: [x, 0.0, 0.0] };
    let keyframes = vec![key(1.0, 0.0), key(1.5, 1.0), key(2.5, 5.0), key(3.0, 5.0)];
    Motion::Keyframes { file: None, keyframes, interpolation }
}

#[test]
fn keyframes_are_met_on_time() {
    for interpolation in [Interpolation::Linear, Interpolation::CatmullRom] {
        let path = path(keyframes(interpolation));
        assert_eq!(path.frames.len(), 121, "two seconds from the first keyframe");
        for (frame, x) in [(0, 0.0), (30, 1.0), (90, 5.0), (120, 5.0)] {
            assert_eq!(path.frames[frame].camera.eye(), Vec3::new(x, 2.0, 9.0));
        }
    }
    assert_eq!(path(keyframes(Interpolation::Linear)).frames[60].camera.eye().x, 3.0);
    let held = scene(keyframes(Interpolation::Linear), Some(200)).expect("a path");
    assert_eq!(held.paths[0].frames[199].camera.eye().x, 5.0, "after the last keyframe it stands");
}

/// Catmull-Rom has one velocity at each inner keyframe: the slope of the chord between its
/// neighbours.
#[test]
fn the_curve_is_smooth() {
    let path = path(keyframes(Interpolation::CatmullRom));
    let x = |frame: usize| path.frames[frame].camera.eye().x;
    let (before, after) = ((x(30) - x(29)) * 60.0, (x(31) - x(30)) * 60.0);
    // A step of 1/60 s on a curve whose acceleration stays below 20 m/s2.
    assert!((before - 5.0 / 1.5).abs() < 0.4 && (after - 5.0 / 1.5).abs() < 0.4, "{before} {after}");
}

#[test]
fn keyframes_come_from_files_too() {
    let folder = tempfile::tempdir().expect("a folder");
    let json = r#"{ "interpolation": "linear", "keyframes": [
        { "time_secs": 0, "eye": [0, 2, 9], "target": [0, 0, 0] },
        { "time_secs": 1, "eye": [2, 2, 9], "target": [0, 0, 0] } ] }"#;
    let toml = "interpolation = \"linear\"\n[[keyframes]]\ntime_secs = 0\neye = [0, 2, 9]\ntarget = [0, 0, 0]\n\
        [[keyframes]]\ntime_secs = 1\neye = [2, 2, 9]\ntarget = [0, 0, 0]\n";
    let scene =
        include_str!("../../../../scenes/edge-ladder/scene.toml").split("[[path]]").next().expect("a head");
    let path = folder.path().join("scene.toml");
    let mut frames = Vec::new();
    for (name, text) in [("keys.json", json), ("keys.toml", toml)] {
        std::fs::write(folder.path().join(name), text).expect("written");
        let motion =
            format!("[[path]]\nname = \"k\"\nmotion = {{ kind = \"keyframes\", file = \"{name}\" }}\n");
        std::fs::write(&path, format!("{scene}{motion}")).expect("written");
        frames.push(Scene::load(folder.path()).expect("a scene").paths.remove(0).frames);
    }
    assert_eq!(frames[0], frames[1]);
    assert_eq!(frames[0][30].camera.eye().x, 1.0);
    std::fs::write(folder.path().join("keys.toml"), "keyframes = [\n{ time = 0 },\n]").expect("written");
    let error = Scene::load(&path).expect_err("an unknown field").to_string();
    assert!(error.contains("keys.toml:2:3: unknown field `time`"), "{error}");
    std::fs::write(folder.path().join("keys.toml"), "keyframes = []").expect("written");
    assert!(Scene::load(&path).expect_err("none").to_string().contains("at least one keyframe"));
}

#[test]
fn keyframes_out_of_order_are_refused() {
    let key = |time_secs: f64| Keyframe { time_secs, eye: EYE, target: TARGET };
    let keyframes = vec![key(0.0), key(1.0), key(1.0)];
    let error =
        scene(Motion::Keyframes { file: None, keyframes, interpolation: Interpolation::Linear }, None);
    let error = error.expect_err("not later").to_string();
    assert!(error.contains("keyframe 2 is not later"), "{error}");
}

/// Every vertex lies before the far plane, from every frame.
#[test]
fn far_reaches_everything() {
    for name in builtin_names() {
        let scene = Scene::builtin(name).expect("a scene");
        let (lo, hi) = scene.geometry.bounds();
        for frame in scene.paths.iter().flat_map(|path| &path.frames) {
            let camera = frame.camera;
            let farthest = (camera.eye() - lo).abs().max((hi - camera.eye()).abs()).length();
            assert!(farthest < camera.far_world && (0.01..=0.1).contains(&camera.near_world), "{name}");
        }
    }
}
