//! Cameras that do not fit, and windows of frames that follow each other.

use super::{COUNT, Handed, WAYS, noisy};
use umbrage_frame::{Image, write_exr};
use umbrage_scene::{Camera, Scene};
use umbrage_tests::{Card, run, umbrage};

fn numbers(m: glam::Mat4) -> [f64; 16] {
    m.to_cols_array().map(f64::from)
}

/// Each of the usual mistakes is refused, by depth and by the shadow alone, and called by its name.
#[test]
fn wrong_cameras_are_refused_by_name() {
    use glam::{Mat4, Vec3};
    let handed = Handed::new();
    for way in WAYS {
        handed.score(&format!("--cameras cameras.json {way}")).ended_with(0);
        let refused = |cameras: &str, words: &str| {
            let ran = handed.score(&format!("--cameras {cameras} {way}")).ended_with(3);
            assert!(
                ran.stderr.contains(words) && ran.stderr.contains("help:"),
                "{cameras}, {way}: {}",
                ran.stderr
            );
        };
        // Unity's numbers: x negated in the world, z in the camera.
        let unity = |c: &Camera| {
            let (world, camera) = (Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, 1.0, -1.0));
            numbers(Mat4::from_scale(world) * c.world_from_camera * Mat4::from_scale(camera))
        };
        handed.write_cameras("unity.json", "{}", unity);
        refused("unity.json", "read as unity writes them");
        // A left-handed world, z mirrored, that no preset is: the cure can be copied, and cures.
        let mirrored = |c: &Camera| {
            let z = Mat4::from_scale(Vec3::new(1.0, 1.0, -1.0));
            numbers(z * c.world_from_camera * z)
        };
        handed.write_cameras("mirrored.json", "{}", mirrored);
        refused("mirrored.json", "set \"forward\": \"+z\", \"camera_forward\": \"+z\"");
        handed.write_cameras("cured.json", "{\"forward\": \"+z\", \"camera_forward\": \"+z\"}", mirrored);
        handed.score(&format!("--cameras cured.json {way}")).ended_with(0);
        handed.score(&format!("--cameras unity.json --convention unity {way}")).ended_with(0);
        handed.write_cameras("cm.json", "{}", |c| {
            let mut m = c.world_from_camera;
            m.w_axis = (m.w_axis.truncate() * 100.0).extend(1.0);
            numbers(m)
        });
        refused("cm.json", "centimetres");
        refused("cm.json", "\"units_per_meter\": 100");
        let wide = std::fs::read_to_string(handed.folder().join("cameras.json")).expect("text");
        let yfov = handed.cameras[0].yfov_radians;
        let wrong = format!("\"yfov\": {}", 2.0 * ((0.5 * yfov).tan() * 1.05).atan());
        std::fs::write(handed.folder().join("wide.json"), wide.replace(&format!("\"yfov\": {yfov}"), &wrong))
            .expect("written");
        // The search ends within a hundredth of a degree; masks of 128 samples carry it no further than a tenth.
        let ran = handed.score(&format!("--cameras wide.json {way}")).ended_with(3);
        let (_, said) = ran.stderr.split_once("vertical field of view of ").expect("a field of view");
        let degrees: f32 = said.split(' ').next().and_then(|d| d.parse().ok()).expect("degrees");
        assert!((degrees - yfov.to_degrees()).abs() < 0.1, "{degrees} for {}", yfov.to_degrees());
        handed.write_cameras("view.json", "{}", |c| numbers(c.world_from_camera.inverse()));
        refused("view.json", "world to camera");
        // Each camera is the one before.
        let later: String = (0..COUNT).rev().fold(wide.clone(), |text, i| {
            text.replace(&format!("\"index\": {i},"), &format!("\"index\": {},", i + 1))
        });
        let later = later.replace(&format!("\"index\": {COUNT},"), "\"index\": 0,");
        std::fs::write(handed.folder().join("later.json"), later).expect("written");
        refused("later.json", "off by one");
    }
    // A light that is not the frames', where depth says that the cameras are right.
    let scene = Scene::builtin("colonnade").expect("a standard scene");
    let umbrage_scene::AreaLight::Sun { direction_to_light: sun, .. } = scene.lights[0] else {
        panic!("the colonnade stands in the sun")
    };
    let turned = [-sun.x, sun.y, -sun.z];
    let text = format!("kind = \"sun\"\nangular_diameter_degrees = 1.0\ndirection_to_light = {turned:?}");
    std::fs::write(handed.folder().join("sun.toml"), text).expect("written");
    let ran = handed.score(&format!("--cameras cameras.json --light sun.toml {}", WAYS[0])).ended_with(3);
    assert!(ran.stderr.contains("not this light's") && ran.stderr.contains("--light"), "{}", ran.stderr);
    // A sun five degrees off, whose direction the frames tell; and one twice as large, which may be the technique's.
    let sun_of = |direction: Vec3, degrees: f32| {
        let vector: [f32; 3] = direction.into();
        let text =
            format!("kind = \"sun\"\nangular_diameter_degrees = {degrees}\ndirection_to_light = {vector:?}");
        std::fs::write(handed.folder().join("other.toml"), text).expect("written");
    };
    let umbrage_scene::AreaLight::Sun { angular_diameter_radians: size, .. } = scene.lights[0] else {
        panic!("the colonnade stands in the sun")
    };
    sun_of(glam::Quat::from_rotation_y(5.0f32.to_radians()) * sun, size.to_degrees());
    for way in WAYS {
        let ran = handed.score(&format!("--cameras cameras.json --light other.toml {way}")).ended_with(3);
        ran.says("not this light's").says("elevation").says("--light");
    }
    sun_of(sun, 4.0 * size.to_degrees());
    let ran = handed.score(&format!("--cameras cameras.json --light other.toml {}", WAYS[0])).ended_with(0);
    ran.says("its penumbrae are those of a light of 0.25 or fewer times the size");
    // The depth itself may be in other units, or a depth buffer's: linear depth d of a near plane at .1 m is .1 / d there.
    let depth_as = |stem: &str, change: &dyn Fn(f32) -> f32| {
        for number in 0..COUNT {
            let mut layers = handed.truth(number);
            layers.iter_mut().filter(|l| l.0 == "depth.Z").for_each(|l| l.1 = l.1.map(|&d| change(d)));
            write_exr(&handed.folder().join(format!("{stem}.{number:04}.exr")), &layers).expect("written");
        }
        let line = format!("--cameras cameras.json --frames {stem}.####.exr --channel reference.V");
        handed.score(&line).ended_with(3)
    };
    depth_as("centimetres", &|d| 100.0 * d)
        .says("with the frames' depth in centimetres")
        .says("write depth in metres");
    depth_as("buffer", &|d| if d > 0.1 { 0.1 / d } else { 0.0 }).says("depth buffer");
    // Every variant is looked at, not the first alone.
    handed
        .rewrite("turned", |_, i| Image::from_fn(i.width(), i.height(), |x, y| *i.at(i.width() - 1 - x, y)));
    let two = "--cameras cameras.json --frames good=shadow.####.exr --frames bad=turned.####.exr";
    handed.score(two).ended_with(3).says("turned.####.exr: ").says("left and right");
    // One frame that is broken is what a score is for; it is no shift of all.
    handed.rewrite("broken", |n, i| if n + 1 == COUNT { noisy(&i.map(|_| 0.5), 5) } else { i.clone() });
    handed.score("--cameras cameras.json --frames broken.####.exr").ended_with(0);
    handed.rewrite("inverse", |_, i| i.map(|v| 1.0 - v));
    let ran = handed.score("--cameras cameras.json --frames inverse.####.exr").ended_with(3);
    assert!(ran.stderr.contains("1 is fully lit"), "{}", ran.stderr);
    // Pictures: upside down, and mirrored.
    handed.rewrite("down", |_, i| Image::from_fn(i.width(), i.height(), |x, y| *i.at(x, i.height() - 1 - y)));
    let ran = handed.score("--cameras cameras.json --frames down.####.exr").ended_with(3);
    assert!(ran.stderr.contains("upside down"), "{}", ran.stderr);
    handed
        .rewrite("mirror", |_, i| Image::from_fn(i.width(), i.height(), |x, y| *i.at(i.width() - 1 - x, y)));
    let ran = handed.score("--cameras cameras.json --frames mirror.####.exr").ended_with(3);
    assert!(ran.stderr.contains("left and right"), "{}", ran.stderr);
    // Something else entirely, and the way round it.
    handed.rewrite("other", |n, i| noisy(&Image::filled(i.width(), i.height(), 0.5), n as u32 + 1));
    let ran = handed.score("--cameras cameras.json --frames other.####.exr").ended_with(3);
    assert!(ran.stderr.contains("no usual mistake explains it"), "{}", ran.stderr);
    handed.score("--cameras cameras.json --frames other.####.exr --no-projection-check").ended_with(0);
}

/// Swimming is between frames that follow each other: none is measured over a gap.
#[test]
fn no_window_spans_a_gap() {
    let handed = Handed::new();
    let cameras = std::fs::read_to_string(handed.folder().join("cameras.json")).expect("text");
    let numbered = |name: &str, numbers: [usize; COUNT]| {
        let text = (0..COUNT).rev().fold(cameras.clone(), |text, i| {
            std::fs::copy(
                handed.folder().join(format!("shadow.{i:04}.exr")),
                handed.folder().join(format!("{name}.{:04}.exr", numbers[i])),
            )
            .expect("copied");
            text.replace(&format!("\"index\": {i},"), &format!("\"index\": {},", numbers[i]))
        });
        std::fs::write(handed.folder().join(format!("{name}.json")), text).expect("written");
        let ran = handed.score(&format!("--cameras {name}.json --frames {name}.####.exr")).ended_with(0);
        (ran, Card::load(&handed.folder().join("run")))
    };
    let (ran, card) = numbered("gap", [1, 2, 3, 20, 21]);
    ran.says("frames are missing after 3: no window spans a gap").says("2 frames do not fill a window of 3");
    let windows = card.windows();
    assert_eq!((windows.len(), &windows[0]["first_frame"], &windows[0]["frames"]), (1, &1.into(), &3.into()));
    let (ran, card) = numbered("thin", [2, 4, 6, 8, 10]);
    ran.says("go by 2: swimming is over 2 frames' motion");
    assert_eq!((&card.windows()[0]["step"], &card.windows()[0]["frames"]), (&2.into(), &5.into()));
    let page = std::fs::read_to_string(handed.folder().join("run/index.html")).expect("a page");
    assert!(page.contains("Frames 2 to 10, every 2"));
}

/// A sun that turns by 12 degrees in 120 frames: each frame is judged by its own.
#[test]
fn a_light_that_moves_is_each_frame_s_own() {
    let home = tempfile::tempdir().expect("a temporary folder");
    let line = "reference thin-poles --path P6 --frames 120 --only-v --size 64x36 --samples 32 --reference-on cpu --out t/t.exr";
    run(&mut umbrage(home.path(), line)).ended_with(0);
    let line = "score --scene thin-poles --path P6 --frames t --deterministic --samples 32 --reference-on cpu --cache c --out run";
    let ran = run(&mut umbrage(home.path(), line)).ended_with(0);
    ran.says("the cameras fit the frames: 0.0").says("the light fits: correlation with truth's shadow");
}
