//! Cut-outs, colours and instances out of OBJ and glTF files.

use crate::{Scene, SceneError};
use glam::{DVec2, Vec2, Vec3};
use image::{ImageFormat, Rgba, RgbaImage};
use serde_json::{Value, json};
use std::io::Cursor;
use std::path::Path;

/// Two by two texels, of which the top left one is not there; the bottom right one is red.
fn png() -> Vec<u8> {
    let texel = |x, y| Rgba(if (x, y) == (1, 1) { [255, 0, 0, 255] } else { [255; 4] });
    let mut picture = RgbaImage::from_fn(2, 2, texel);
    picture.put_pixel(0, 0, Rgba([255, 255, 255, 100]));
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).expect("encoded");
    bytes.into_inner()
}

fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A triangle (0,0,0) (1,0,0) (0,1,0) with uv as its xy, and two translations.
fn document() -> Value {
    json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "name": "leaf", "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "material": 0 }] }],
        "materials": [{ "name": "leaf", "alphaMode": "MASK", "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 1.0, 1.0, 1.0], "baseColorTexture": { "index": 0 } } }],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{ "wrapS": 33071, "wrapT": 33648 }],
        "images": [{ "uri": "a%20leaf.png" }],
        "buffers": [{ "uri": "data.bin", "byteLength": 84 }],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 24 },
            { "buffer": 0, "byteOffset": 60, "byteLength": 24 },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
              "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 0.0] },
            { "bufferView": 1, "componentType": 5126, "type": "VEC2", "count": 3 },
            { "bufferView": 2, "componentType": 5126, "type": "VEC3", "count": 2 },
        ],
    })
}

fn write(folder: &Path, document: &Value) {
    let mut data = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
    data.extend(floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]));
    data.extend(floats(&[0.0, 0.0, 0.0, 5.0, 0.0, 0.0]));
    std::fs::write(folder.join("data.bin"), data).expect("written");
    std::fs::write(folder.join("leaf.gltf"), document.to_string()).expect("written");
}

fn load(document: &Value) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("a leaf.png"), png()).expect("written");
    write(folder.path(), document);
    Scene::load(&folder.path().join("leaf.gltf"))
}

fn is_there(scene: &Scene, u: f64, v: f64) -> bool {
    scene.materials[0].mask.as_ref().expect("a mask").is_opaque(DVec2::new(u, v))
}

#[test]
fn gltf_masks_cut_below_their_cutoff() {
    let scene = load(&document()).expect("a scene");
    assert!(scene.has_masks());
    assert!(!is_there(&scene, 0.25, 0.25) && is_there(&scene, 0.75, 0.25) && is_there(&scene, 0.25, 0.75));
    // Clamped along u, turned over along v.
    assert!(!is_there(&scene, -3.0, 0.25) && is_there(&scene, 3.0, 0.25));
    assert!(!is_there(&scene, 0.25, -0.25) && !is_there(&scene, 0.25, 1.9));
    assert_eq!(scene.geometry.uvs, [[Vec2::ZERO, Vec2::X, Vec2::Y]]);

    // 100 / 255 is .39.
    let mut low = document();
    low["materials"][0]["alphaCutoff"] = json!(0.39);
    assert!(!load(&low).expect("a scene").has_masks(), "nothing is cut out");
    low["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = json!([1.0, 1.0, 1.0, 0.9]);
    assert!(load(&low).expect("a scene").has_masks());
}

#[test]
fn materials_are_whole_unless_they_say_mask() {
    for mode in ["OPAQUE", "BLEND"] {
        let mut document = document();
        document["materials"][0]["alphaMode"] = json!(mode);
        let scene = load(&document).expect("a scene");
        assert!(!scene.has_masks());
        let noted = scene.notes.iter().any(|note| note.contains("translucent"));
        assert_eq!(noted, mode == "BLEND", "{:?}", scene.notes);
    }
}

#[test]
fn colours_are_the_factor_times_the_picture() {
    let scene = load(&document()).expect("a scene");
    // Of the middle of the bottom right texel; the triangle's plane goes on beyond its edge.
    let albedo = scene.albedo_at(0, Vec3::new(0.75, 0.75, 0.0));
    assert!(albedo.distance(Vec3::new(0.5, 0.0, 0.0)) < 1e-6, "{albedo}");
}

#[test]
fn a_missing_picture_is_an_error_where_it_cuts_and_a_note_where_it_colours() {
    let load = |mode: &str| {
        let folder = tempfile::tempdir().expect("a folder");
        let mut document = document();
        document["materials"][0]["alphaMode"] = json!(mode);
        write(folder.path(), &document);
        Scene::load(&folder.path().join("leaf.gltf"))
    };
    let error = load("MASK").expect_err("no picture").to_string();
    for part in ["leaf.gltf", "'leaf'", "a leaf.png", "put the file there"] {
        assert!(error.contains(part), "{error}");
    }
    let notes = load("OPAQUE").expect("a scene").notes;
    assert!(notes.iter().any(|note| note.contains("a leaf.png")), "{notes:?}");
}

/// Without a place the picture's first texel would decide about all of the surface.
#[test]
fn a_cut_out_without_texture_coordinates_is_an_error() {
    let mut bare = document();
    bare["meshes"][0]["primitives"][0]["attributes"]
        .as_object_mut()
        .expect("attributes")
        .remove("TEXCOORD_0");
    let error = load(&bare).map(|_| ()).expect_err("no place").to_string();
    for part in ["leaf.gltf", "'leaf'", "no texture coordinates", "TEXCOORD"] {
        assert!(error.contains(part), "{error}");
    }
    // A colour may be taken from anywhere, with a note; and a factor alone needs no place.
    bare["materials"][0]["alphaMode"] = json!("OPAQUE");
    let notes = load(&bare).expect("a scene").notes;
    assert!(notes.iter().any(|note| note.contains("first texel")), "{notes:?}");
    bare["materials"][0] =
        json!({ "alphaMode": "MASK", "pbrMetallicRoughness": { "baseColorFactor": [1.0, 1.0, 1.0, 0.2] } });
    load(&bare).expect("a scene that is not there, but said to be");

    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).expect("written");
    file("leaf.mtl", b"newmtl leaf\nmap_d leaf.png\n");
    file("leaf.png", &png());
    let corners = "mtllib leaf.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 1 1\nusemtl leaf\n";
    for faces in ["f 1 2 3\n", "f 1/1 2/1 3/1\nf 2 4 3\n"] {
        file("leaf.obj", format!("{corners}{faces}").as_bytes());
        let error = Scene::load(&folder.path().join("leaf.obj")).map(|_| ()).expect_err(faces).to_string();
        assert!(error.contains("leaf.obj") && error.contains("no texture coordinates"), "{error}");
    }
}

#[test]
fn texture_transforms_scale_turn_and_move() {
    let mut document = document();
    document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = json!({ "KHR_texture_transform": { "offset": [0.5, 0.25], "scale": [2.0, 3.0],
                "rotation": std::f32::consts::FRAC_PI_2 } });
    document["extensionsUsed"] = json!(["KHR_texture_transform"]);
    let uvs = load(&document).expect("a scene").geometry.uvs[0];
    // (u, v) -> (0.5 + 3 v, 0.25 - 2 u): the sample viewer's matrix.
    let expected = [Vec2::new(0.5, 0.25), Vec2::new(0.5, -1.75), Vec2::new(3.5, 0.25)];
    assert!(uvs.iter().zip(expected).all(|(uv, e)| uv.distance(e) < 1e-6), "{uvs:?}");
}

#[test]
fn instances_stand_where_they_are_told() {
    let mut document = document();
    document["nodes"][0]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": 2 } } });
    document["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    let scene = load(&document).expect("a scene");
    assert_eq!(scene.geometry.triangles.len(), 2);
    assert_eq!(scene.geometry.corners(1).map(|c| c.x), [5.0, 6.0, 5.0]);
    assert_eq!(scene.geometry.uvs[0], scene.geometry.uvs[1]);
    // The same mesh under a mirroring node: turned back with its places in the picture.
    document["nodes"][0] = json!({ "mesh": 0, "scale": [-1.0, 1.0, 1.0] });
    let mirrored = load(&document).expect("a scene");
    let [a, b, c] = mirrored.geometry.corners(0);
    assert!((b - a).cross(c - a).z > 0.0, "the front stays in front");
    for (corner, uv) in mirrored.geometry.corners(0).iter().zip(mirrored.geometry.uvs[0]) {
        assert_eq!(Vec2::new(-corner.x, corner.y), uv);
    }
}

#[test]
fn an_extension_that_is_needed_and_not_read_is_an_error() {
    let mut document = document();
    document["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let error = load(&document).expect_err("compressed").to_string();
    assert!(error.contains("KHR_draco_mesh_compression") && error.contains("export it without"), "{error}");
    document["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
    document["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": {} } });
    assert!(load(&document).expect_err("no attribute").to_string().contains("neither TRANSLATION"));
}

/// One leaf: `map_d` cuts it out (its alpha), `map_Kd` colours it; OBJ counts v from the bottom.
#[test]
fn obj_libraries_cut_and_colour() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).expect("written");
    file("leaf.mtl", b"newmtl leaf\nKd 0.5 1 1\nmap_Kd -s 1 1 1 leaf.png\n map_d -clamp on leaf.png\n");
    file("leaf.png", &png());
    let obj = "mtllib leaf.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 1\nvt 1 1 0\nvt 0 0\nvn 0 0 1\n\
               usemtl leaf\nf 1/1/1 2/2/1 3/3\n";
    file("leaf.obj", obj.as_bytes());
    let scene = Scene::load(&folder.path().join("leaf.obj")).expect("a scene");
    assert_eq!(scene.geometry.uvs, [[Vec2::ZERO, Vec2::X, Vec2::Y]]);
    assert!(!is_there(&scene, 0.25, 0.25) && is_there(&scene, 0.75, 0.25) && is_there(&scene, 0.75, 5.0));
    let albedo = scene.albedo_at(0, Vec3::new(0.75, 0.75, 0.0));
    assert!(albedo.distance(Vec3::new(0.5, 0.0, 0.0)) < 1e-6, "{albedo}");

    std::fs::remove_file(folder.path().join("leaf.png")).expect("removed");
    let error = Scene::load(&folder.path().join("leaf.obj")).expect_err("no picture").to_string();
    for part in ["leaf.obj", "'leaf'", "leaf.png", "take the line out"] {
        assert!(error.contains(part), "{error}");
    }
    // Damaged bytes are told from missing ones.
    file("leaf.png", &png()[..40]);
    let error = Scene::load(&folder.path().join("leaf.obj")).expect_err("damaged").to_string();
    assert!(error.contains("PNG and JPEG"), "{error}");
}

/// A brightness is taken where a picture has no alpha.
#[test]
fn a_grey_map_d_is_white_where_the_surface_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let grey = image::GrayImage::from_fn(2, 1, |x, _| image::Luma([if x == 0 { 120 } else { 140 }]));
    grey.save(folder.path().join("d.png")).expect("written");
    std::fs::write(folder.path().join("l.mtl"), "newmtl l\nmap_d d.png\n").expect("written");
    let obj = "mtllib l.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl l\nf 1/1 2/1 3/1\n";
    std::fs::write(folder.path().join("l.obj"), obj).expect("written");
    let scene = Scene::load(&folder.path().join("l.obj")).expect("a scene");
    assert!(!is_there(&scene, 0.2, 0.5) && is_there(&scene, 0.7, 0.5));
}

/// Lossy, but a white picture with a black half stays one.
#[test]
fn jpeg_is_read() {
    let grey = image::RgbImage::from_fn(16, 8, |x, _| image::Rgb([if x < 8 { 0 } else { 255 }; 3]));
    let mut bytes = Cursor::new(Vec::new());
    grey.write_to(&mut bytes, ImageFormat::Jpeg).expect("encoded");
    let picture = crate::picture::Picture::decode(&bytes.into_inner()).expect("decoded");
    let mask = picture.mask([crate::Wrap::Repeat; 2], crate::picture::Opacity::Dissolve);
    assert!(!mask.is_opaque(DVec2::new(0.2, 0.5)) && mask.is_opaque(DVec2::new(0.8, 0.5)));
}

#[test]
fn lights_of_a_file_are_left_out_with_a_note() {
    let mut document = document();
    document["extensions"] =
        json!({ "KHR_lights_punctual": { "lights": [{ "type": "point", "color": [1.0, 1.0, 1.0] }] } });
    document["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
    let notes = load(&document).expect("a scene").notes;
    assert!(notes.iter().any(|note| note.starts_with("1 lights of the file")), "{notes:?}");
}
