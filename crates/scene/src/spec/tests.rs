use super::*;
use crate::{AreaLight, Scene, builtin_names};
use glam::Vec3;
use proptest::prelude::*;

const SMALL: &str = r#"
title = "small"

[geometry]
generator = "edge-ladder"

[[light]]
kind = "sun"
angular_diameter_degrees = 2.0
elevation_degrees = 50.0
azimuth_degrees = 30.0

[[path]]
name = "P0"
motion = { kind = "still", eye = [0, 5, 9], target = [0, 0, 0] }
"#;

fn parse(source: &str) -> Result<SceneFile, SceneError> {
    SceneFile::parse(source, Path::new("here/scene.toml"))
}

fn build(source: &str) -> Result<Scene, SceneError> {
    Scene::from_file("small", &parse(source)?, Path::new("here/scene.toml"))
}

/// What goes wrong when this part of the small scene reads otherwise.
fn error_with(part: &str, instead: &str) -> String {
    assert!(SMALL.contains(part), "{part}");
    build(&SMALL.replace(part, instead)).expect_err("a mistake").to_string()
}

#[test]
fn reads_what_it_writes() {
    let mut file = parse(SMALL).expect("a scene file");
    file.shadow_region =
        Some(ShadowRegionSpec { centre: [0.1, 0.2, 0.3], width_world: 30.0, reference_gap_world: 1.3 });
    file.lights.push(LightSpec::Disk {
        centre: [0.0, 3.0, 0.0],
        normal: [0.0, -1.0, 0.0],
        radius_world: 0.3,
    });
    file.lights.push(LightSpec::Rect { centre: [0.0; 3], half_u: [1.0, 0.0, 0.0], half_v: [0.0, 0.0, 1e-3] });
    file.lights.push(LightSpec::Sphere { centre: [1e6, 0.1, -0.7], radius_world: 0.0 });
    let key = |time_secs| Keyframe { time_secs, eye: [0.0, 1.0, time_secs], target: [0.0, 0.0, -5.0] };
    file.paths.push(PathSpec {
        name: "keys".to_owned(),
        title: Some("with \"quotes\"".to_owned()),
        frames: Some(7),
        frames_per_second: 24.0,
        yfov_degrees: 45.0,
        motion: Motion::Keyframes {
            file: None,
            keyframes: vec![key(0.0), key(0.5)],
            interpolation: Interpolation::Linear,
        },
    });
    let written = file.to_toml();
    assert_eq!(parse(&written).expect("readable"), file, "{written}");
    assert!(written.starts_with("# A scene for Umbrage"), "{written}");
}

#[test]
fn the_standard_scenes_read_back() {
    for name in builtin_names() {
        let source =
            std::fs::read_to_string(format!("{}/../../scenes/{name}/scene.toml", env!("CARGO_MANIFEST_DIR")));
        let file = parse(&source.expect("the folder is called as the scene")).expect("valid");
        assert_eq!(parse(&file.to_toml()).expect("readable"), file);
        let names: Vec<&str> = file.paths.iter().map(|path| path.name.as_str()).collect();
        let (suite, more): (Vec<&str>, Vec<&str>) = names.into_iter().partition(|name| name.len() == 2);
        assert_eq!(suite, ["P0", "P1", "P2", "P3", "P4", "P5", "P6"]);
        let expected: &[&str] = match name {
            "edge-ladder" | "colonnade" => &["P1-far", "P6-slow"],
            "oblique-floor" => &["P1-far"],
            "foliage" => &["P6-slow"],
            _ => &[],
        };
        assert_eq!(more, expected, "{name}");
    }
}

#[test]
fn unknown_fields_are_named_with_their_line() {
    let cases = [
        ("title = \"small\"", "titel = \"small\"", "here/scene.toml:2:1: unknown field `titel`"),
        ("generator", "generatr", "scene.toml:5:1: unknown field `generatr`"),
        ("kind = \"sun\"", "kind = \"sun\"\nsize = 2", "scene.toml:9:1: unknown field `size`"),
        ("name = \"P0\"", "name = \"P0\"\nframe = 3", "scene.toml:15:1: unknown field `frame`"),
        (
            "target = [0, 0, 0] }",
            "target = [0, 0, 0], speed = 1 }",
            "scene.toml:15:65: unknown field `speed`",
        ),
    ];
    for (part, instead, expected) in cases {
        let error = error_with(part, instead);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn wrong_types_and_kinds_have_a_place() {
    let cases = [
        ("\"sun\"", "\"sum\"", "scene.toml:8:8: unknown variant `sum`, expected one of `sun`"),
        ("\"edge-ladder\"", "\"ladder\"", "scene.toml:5:13: unknown variant `ladder`"),
        ("azimuth_degrees = 30.0", "azimuth_degrees = \"east\"", "invalid type: string \"east\""),
        ("angular_diameter_degrees = 2.0\n", "", "missing field `angular_diameter_degrees`"),
        ("title = \"small\"", "title = ", "scene.toml:2:"),
    ];
    for (part, instead, expected) in cases {
        let error = error_with(part, instead);
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn senseless_values_are_refused_with_a_reason() {
    let path = "motion = { kind = \"still\", eye = [0, 5, 9], target = [0, 0, 0] }";
    let cases = [
        ("= 2.0", "= -2.0", "light 1: angular_diameter_degrees must be at least 0, is -2"),
        ("= 2.0", "= nan", "angular_diameter_degrees must be finite, is NaN"),
        ("= 2.0", "= 180.0", "must be below 180"),
        ("azimuth_degrees = 30.0\n", "", "either direction_to_light or both"),
        ("azimuth_degrees = 30.0", "direction_to_light = [0, 1, 0]", "either direction_to_light or both"),
        ("eye = [0, 5, 9]", "eye = [0, 0, 0]", "path 'P0': eye and target must differ"),
        ("eye = [0, 5, 9]", "eye = [0, inf, 9]", "eye and target must be finite"),
        ("name = \"P0\"", "name = \"P0\"\nframes = 0", "frames must be 1 to 100000, is 0"),
        ("name = \"P0\"", "name = \"P0\"\nframes_per_second = 0", "frames_per_second must be above 0"),
        ("name = \"P0\"", "name = \"P0\"\nyfov_degrees = 180", "below 180"),
        ("generator = \"edge-ladder\"", "", "either a generator or files"),
        ("generator = \"edge-ladder\"", "generator = \"edge-ladder\"\nscale = 0", "scale must be above 0"),
        (
            "generator = \"edge-ladder\"",
            "generator = \"edge-ladder\"\nskip_objects = [\"flor\"]",
            "did you mean 'floor'?",
        ),
        (
            "[[light]]",
            "[shadow_region]\ncentre = [0, 0, 0]\nwidth_world = 0\nreference_gap_world = 1\n[[light]]",
            "must be above 0",
        ),
        (
            path,
            "motion = { kind = \"orbit\", target = [0, 0, 0], radius_world = 0, pitch_degrees = 0, azimuth_degrees = 0, degrees_per_second = 1 }",
            "radius_world above 0",
        ),
        (path, "motion = { kind = \"gltf\", camera = \"eye\" }", "no camera called 'eye'"),
        (path, "motion = { kind = \"keyframes\" }", "at least one keyframe"),
        (path, "motion = { kind = \"keyframes\", file = \"nowhere.json\" }", "cannot read here/nowhere.json"),
        (
            path,
            "motion = { kind = \"creep\", eye = [0, 5, 9], target = [0, 0, 0], reference_height_px = 0 }",
            "the camera is nowhere in frame 0",
        ),
    ];
    for (part, instead, expected) in cases {
        let error = error_with(part, instead);
        assert!(error.contains(expected), "{instead}: {error}");
    }
    let twice = format!("{SMALL}\n[[path]]\nname = \"P0\"\n{path}\n");
    assert!(build(&twice).expect_err("twice").to_string().contains("two paths are called 'P0'"));
    let mut file = parse(SMALL).expect("valid");
    file.lights.clear();
    let error = Scene::from_file("x", &file, Path::new("x.toml")).expect_err("no light");
    assert!(error.to_string().contains("at least one [[light]]"), "{error}");
}

#[test]
fn lights_of_no_size_are_allowed() {
    let scene = build(&SMALL.replace("= 2.0", "= 0.0")).expect("a hard shadow");
    assert_eq!(scene.lights[0].angular_diameter_radians(), Some(0.0));
    let sphere = "kind = \"sphere\"\ncentre = [0, 4, 0]\nradius_world = 0\n\n[[path]]";
    let (head, tail) = SMALL.split_once("kind = \"sun\"").expect("a sun");
    let tail = tail.split_once("[[path]]").expect("a path").1;
    let scene = build(&format!("{head}{sphere}{tail}")).expect("a point");
    assert_eq!(scene.lights[0], AreaLight::Sphere { centre: Vec3::new(0.0, 4.0, 0.0), radius_world: 0.0 });
}

#[test]
fn both_ways_to_place_a_sun_agree() {
    let by_angles = build(SMALL).expect("valid").lights[0];
    let (elevation, azimuth) = (50f64.to_radians(), 30f64.to_radians());
    let vector = [elevation.cos() * azimuth.cos(), elevation.sin(), elevation.cos() * azimuth.sin()];
    let text = format!("direction_to_light = {:?}", vector.map(|c| c * 7.0));
    let source = SMALL.replace("elevation_degrees = 50.0\nazimuth_degrees = 30.0", &text);
    let by_vector = build(&source).expect("valid").lights[0];
    // Two roundings to f32.
    let difference = by_angles.direction_from(Vec3::ZERO) - by_vector.direction_from(Vec3::ZERO);
    assert!(difference.length() < 2e-7, "{difference}");
}

proptest! {
    #[test]
    fn no_text_panics(source in "\\PC{0,200}") {
        let _ = build(&source);
        let _ = keyframes_from(&source, Path::new("k.json"));
        let _ = keyframes_from(&source, Path::new("k.toml"));
    }

    /// The small scene with another number in one place.
    #[test]
    fn no_number_panics(at in 0usize..14, number in any::<f64>()) {
        let numbers: Vec<(usize, &str)> = SMALL.match_indices(|c: char| c.is_ascii_digit()).collect();
        let (start, digit) = numbers[at % numbers.len()];
        let source = format!("{}{number:?}{}", &SMALL[..start], &SMALL[start + digit.len()..]);
        let _ = build(&source);
    }
}
