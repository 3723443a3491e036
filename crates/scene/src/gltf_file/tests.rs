use super::parse;
use crate::{CameraPath, Scene, SceneError};
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use serde_json::{Value, json};
use std::path::Path;

/// RFC 4648, with padding.
fn base64(bytes: &[u8]) -> String {
    let letters: Vec<char> = ('A'..='Z').chain('a'..='z').chain('0'..='9').chain(['+', '/']).collect();
    let group = |chunk: &[u8]| {
        let bits = chunk.iter().chain([&0, &0]).take(3).fold(0, |n, &byte| n << 8 | usize::from(byte));
        let letter = |k: usize| if k <= chunk.len() { letters[bits >> (18 - 6 * k) & 63] } else { '=' };
        [letter(0), letter(1), letter(2), letter(3)]
    };
    bytes.chunks(3).flat_map(group).collect()
}

fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A triangle (0,0,0) (1,0,0) (0,1,0), a camera track of 0, 1 and 2 seconds along x, and quaternions
/// of 0, 90 and 0 degrees round y.
fn buffer() -> Vec<u8> {
    let mut bytes = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    bytes.extend([0u16, 1, 2, 0].iter().flat_map(|i| i.to_le_bytes()));
    bytes.extend(floats(&[0.0, 1.0, 2.0]));
    bytes.extend(floats(&[0.0, 0.0, 5.0, 4.0, 0.0, 5.0, 4.0, 2.0, 5.0]));
    bytes.extend(floats(&[0.0, 0.0, 0.0, 1.0, 0.0, HALF, 0.0, HALF, 0.0, 0.0, 0.0, 1.0]));
    bytes
}

fn accessor(view: usize, kind: u32, shape: &str, count: usize) -> Value {
    json!({ "bufferView": view, "componentType": kind, "type": shape, "count": count,
            "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 0.0] })
}

/// Half the square root of two: the quaternion of a quarter turn.
const HALF: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// A mesh two nodes deep (the outer one moved and turned, the inner one mirrored), and a camera.
fn document(uri: Option<&str>) -> Value {
    let mut main = json!({ "byteLength": buffer().len() });
    if let Some(uri) = uri {
        main["uri"] = json!(uri);
    }
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 2] }],
        "nodes": [
            { "name": "outer", "children": [1], "translation": [10.0, 0.0, 0.0],
              "rotation": [0.0, HALF, 0.0, HALF] },
            { "name": "inner", "mesh": 0, "scale": [-2.0, 1.0, 1.0] },
            { "name": "eye", "camera": 0, "translation": [0.0, 0.0, 5.0] },
        ],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "materials": [{ "name": "red", "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.1, 0.2, 1.0] } }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } }],
        "buffers": [main],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 6 },
            { "buffer": 0, "byteOffset": 44, "byteLength": 12 },
            { "buffer": 0, "byteOffset": 56, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 92, "byteLength": 48 },
        ],
        "accessors": [
            accessor(0, 5126, "VEC3", 3),
            accessor(1, 5123, "SCALAR", 3),
            accessor(2, 5126, "SCALAR", 3),
            accessor(3, 5126, "VEC3", 3),
            accessor(4, 5126, "VEC4", 3),
        ],
    })
}

fn data_uri() -> String {
    format!("data:application/octet-stream;base64,{}", base64(&buffer()))
}

/// The document with its camera animated by samplers of these interpolations.
fn animated(translation: &str, rotation: &str) -> Value {
    let mut document = document(Some(&data_uri()));
    document["animations"] = json!([{
        "channels": [
            { "sampler": 0, "target": { "node": 2, "path": "translation" } },
            { "sampler": 1, "target": { "node": 2, "path": "rotation" } },
        ],
        "samplers": [
            { "input": 2, "output": 3, "interpolation": translation },
            { "input": 2, "output": 4, "interpolation": rotation },
        ],
    }]);
    document
}

fn load(document: &Value) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("model.gltf");
    std::fs::write(&path, document.to_string()).expect("written");
    Scene::load(&path)
}

fn message(document: &Value) -> String {
    load(document).expect_err("a broken file").to_string()
}

fn eyes(path: &CameraPath) -> Vec<Vec3> {
    path.frames.iter().map(|frame| frame.camera.eye()).collect()
}

#[test]
fn nodes_nest_and_mirrors_keep_the_outside_out() {
    let scene = load(&document(Some(&data_uri()))).expect("a scene");
    // Mirrored in x, turned 90 degrees round y (x to -z), moved by 10: (x, y) -> (10, y, 2 x).
    let expected = [DVec3::new(10.0, 0.0, 0.0), DVec3::new(10.0, 1.0, 0.0), DVec3::new(10.0, 0.0, 2.0)];
    let corners = scene.geometry.corners(0).map(|corner| corner.as_dvec3());
    // The quaternion is rounded to f32, and f32 at 10 m steps by 1e-6.
    for (corner, expected) in corners.iter().zip(expected) {
        assert!(corner.distance(expected) < 2e-6, "{corner} is not {expected}");
    }
    // Counter-clockwise from +z before, hence from +x after the turn; the mirror must not change it.
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    assert!(normal.x > 0.0, "{normal}");
    let albedo = scene.materials[scene.geometry.material[0] as usize].albedo;
    assert_eq!(albedo, Vec3::new(0.8, 0.1, 0.2));
}

#[test]
fn a_camera_that_stands_is_a_still_path() {
    let scene = load(&document(Some(&data_uri()))).expect("a scene");
    let path = scene.path("eye").expect("the camera's path");
    assert_eq!(path.frames.len(), 120);
    assert_eq!(eyes(path)[119], Vec3::new(0.0, 0.0, 5.0));
    assert_eq!(path.frames[0].camera.yfov_radians, 0.8);
    let forward = -path.frames[0].camera.world_from_camera.z_axis.truncate();
    assert_eq!(forward, Vec3::NEG_Z);
}

#[test]
fn a_moving_camera_is_sampled_at_the_frame_rate() {
    let scene = load(&animated("LINEAR", "LINEAR")).expect("a scene");
    let path = scene.path("eye").expect("the camera's path");
    assert_eq!(path.frames.len(), 121, "two seconds at 60 frames a second");
    let eyes = eyes(path);
    // Rounding of t = 15/60 and 90/60 (exact in binary) and of f32: nothing to admit.
    assert_eq!(eyes[15], Vec3::new(1.0, 0.0, 5.0));
    assert_eq!(eyes[90], Vec3::new(4.0, 1.0, 5.0));
    // Half way to 90 degrees round y: the view turns from -z towards -x. f32 rounding only.
    let forward = -path.frames[30].camera.world_from_camera.z_axis.truncate();
    assert!(forward.distance(Vec3::new(-HALF, 0.0, -HALF)) < 1e-6, "{forward}");
}

#[test]
fn steps_hold_their_value() {
    let scene = load(&animated("STEP", "STEP")).expect("a scene");
    let eyes = eyes(scene.path("eye").expect("the camera's path"));
    assert_eq!([eyes[59], eyes[60], eyes[120]].map(|eye| eye.x), [0.0, 4.0, 4.0]);
    assert_eq!(eyes[120].y, 2.0);
}

/// With one keyframe's worth of numbers read as slope, value, slope: a cubic spline of one key.
#[test]
fn cubic_splines_take_three_values_a_key() {
    let mut document = animated("CUBICSPLINE", "LINEAR");
    assert!(message(&document).contains("do not fit together"));
    // One time, three vectors: the middle one is the value.
    document["accessors"][2]["count"] = json!(1);
    document["accessors"][4]["count"] = json!(1);
    let scene = load(&document).expect("a scene");
    assert_eq!(eyes(scene.path("eye").expect("a path"))[7], Vec3::new(4.0, 0.0, 5.0));
}

#[test]
fn reads_binary_files_and_files_beside() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("my data.bin"), buffer()).expect("written");
    let path = folder.path().join("beside.gltf");
    std::fs::write(&path, document(Some("my%20data.bin")).to_string()).expect("written");
    let beside = Scene::load(&path).expect("a scene");

    let path = folder.path().join("all.glb");
    std::fs::write(&path, glb(&document(None).to_string(), &buffer())).expect("written");
    let binary = Scene::load(&path).expect("a scene");
    assert_eq!(beside.geometry, binary.geometry);
    assert_eq!(beside.content_hash(), binary.content_hash());
}

/// The binary container: header, JSON chunk, BIN chunk.
fn glb(json: &str, bin: &[u8]) -> Vec<u8> {
    let padded = format!("{json:<width$}", width = json.len().next_multiple_of(4));
    let words =
        |numbers: &[usize]| numbers.iter().flat_map(|&n| (n as u32).to_le_bytes()).collect::<Vec<_>>();
    let mut bytes = b"glTF".to_vec();
    bytes.extend(words(&[2, 12 + 8 + padded.len() + 8 + bin.len(), padded.len()]));
    bytes.extend(b"JSON");
    bytes.extend(padded.bytes());
    bytes.extend(words(&[bin.len()]));
    bytes.extend(b"BIN\0");
    bytes.extend(bin);
    bytes
}

#[test]
fn what_does_not_fit_is_an_error_that_says_so() {
    let broken = |pointer: &str, value: Value| {
        let mut document = animated("LINEAR", "LINEAR");
        *document.pointer_mut(pointer).expect("a place in the document") = value;
        message(&document)
    };
    assert!(broken("/accessors/0/count", json!(4)).contains("reaches beyond its buffer"));
    assert!(broken("/bufferViews/0/byteLength", json!(1 << 20)).contains("reaches beyond its buffer"));
    assert!(broken("/accessors/0/type", json!("VEC2")).contains("holds Vec2"));
    assert!(broken("/accessors/1/componentType", json!(5126)).contains("holds no indices"));
    assert!(broken("/buffers/0/byteLength", json!(1 << 20)).contains("truncated"));
    assert!(broken("/buffers/0/uri", json!("nowhere.bin")).contains("cannot read nowhere.bin"));
    assert!(broken("/nodes/1", json!({ "children": [0] })).contains("hangs below itself"));
    assert!(broken("/animations/0/channels/0/target/node", json!(9)).contains("does not exist"));
    assert!(broken("/meshes/0/primitives/0/attributes/POSITION", json!(5)).contains("accessor 5"));
    assert!(broken("/cameras/0/perspective/yfov", json!(7.0)).contains("field of view"));
    assert!(broken("/scenes/0/nodes", json!([2])).contains("no triangle"));
    let missing = message(&json!({ "asset": { "version": "2.0" } }));
    assert!(missing.contains("model.gltf") && missing.contains("no triangle"), "{missing}");
}

#[test]
fn bad_indices_and_vertices_are_named() {
    let mut document = document(None);
    let with = |bytes: Vec<u8>| parse_scene(&glb(&document.to_string(), &bytes));
    let mut bytes = buffer();
    bytes[40] = 7;
    assert!(matches!(with(bytes), Err(SceneError::IndexOutOfRange { vertex: 7, vertices: 3, .. })));
    let mut bytes = buffer();
    bytes[12..16].copy_from_slice(&f32::NAN.to_le_bytes());
    let error = with(bytes).expect_err("not finite");
    assert!(
        matches!(&error, SceneError::VertexNotFinite { object, vertex: 1, .. } if object == "inner"),
        "{error}"
    );
    document["meshes"][0]["primitives"][0]["mode"] = json!(1);
    let error = parse_scene(&glb(&document.to_string(), &buffer())).expect_err("lines only");
    assert!(matches!(error, SceneError::NoTriangles { .. }), "{error}");
}

fn parse_scene(bytes: &[u8]) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("model.glb");
    std::fs::write(&path, bytes).expect("written");
    Scene::load(&path)
}

#[test]
fn every_truncation_is_an_error() {
    let bytes = glb(&document(None).to_string(), &buffer());
    for length in 0..bytes.len() {
        assert!(parse(&bytes[..length], Path::new("x.glb")).is_err(), "{length} bytes");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn no_bytes_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let _ = parse(&bytes, Path::new("x.glb"));
    }

    /// A valid document in which some numbers and letters are others.
    #[test]
    fn no_wrong_value_panics(changes in proptest::collection::vec((any::<prop::sample::Index>(), "[0-9a-zA-Z%\\-.\\[\\]]"), 1..4)) {
        let mut text = animated("LINEAR", "STEP").to_string().into_bytes();
        for (at, with) in changes {
            let at = at.index(text.len());
            text[at] = with.as_bytes()[0];
        }
        let _ = parse(&text, Path::new("x.gltf"));
    }

    /// A valid document with another number in one place.
    #[test]
    fn no_wrong_number_panics(at in any::<prop::sample::Index>(), number in prop_oneof![Just(u64::MAX), Just(1 << 40), 0u64..300, Just(5120), Just(5125)]) {
        let text = animated("LINEAR", "CUBICSPLINE").to_string();
        let digits = |c: char| c.is_ascii_digit();
        let places: Vec<(usize, &str)> = text.match_indices(digits).collect();
        let (start, _) = places[at.index(places.len())];
        let length = text[start..].find(|c| !digits(c)).unwrap_or(1);
        let changed = format!("{}{number}{}", &text[..start], &text[start + length..]);
        let _ = parse(changed.as_bytes(), Path::new("x.gltf"));
    }
}
