//! Files that are missing, cut short or wrong: exit 4, the file is named, nothing is left behind.

use std::path::Path;
use umbrage_tests::{DOLLY, Mesh, Ran, SUN, empty_folder, folder_with_scene, run, scene_toml, umbrage};

const FLAGS: &str = "--variant hard --size 32x18 --frames 2 --seeds 2 --samples 16 --map 64 --out run";

fn evaluate(folder: &Path, file: &str) -> Ran {
    run(&mut umbrage(folder, &format!("evaluate {file} {FLAGS}")))
}

/// Evaluates a file of this text; it must be refused with these words, and before anything is made.
fn refused(name: &str, text: impl AsRef<[u8]>, words: &[&str]) {
    let folder = empty_folder();
    std::fs::write(folder.path().join(name), text).expect("written");
    let ran = evaluate(folder.path(), name).ended_with(4).says(name);
    words.iter().fold(ran, |ran, words| ran.says(words));
    assert!(!folder.path().join("run").exists(), "{name}: a run was begun");
}

#[test]
fn missing_files() {
    let folder = empty_folder();
    for name in ["no.obj", "no.gltf", "no.glb", "no.toml", "nowhere/scene.toml"] {
        evaluate(folder.path(), name).ended_with(4).says(name).says("No such file");
    }
    std::fs::create_dir(folder.path().join("hollow")).expect("made");
    evaluate(folder.path(), "hollow").ended_with(4).says("scene.toml");
    std::fs::write(folder.path().join("notes.txt"), "x").expect("written");
    evaluate(folder.path(), "notes.txt").ended_with(4).says("notes.txt").says(".gltf");
}

#[test]
fn a_scene_whose_model_is_missing() {
    let folder = empty_folder();
    std::fs::write(folder.path().join("scene.toml"), scene_toml(SUN, DOLLY)).expect("written");
    evaluate(folder.path(), "scene.toml").ended_with(4).says("model.obj").says("No such file");
}

#[test]
fn truncated_obj() {
    let whole = Mesh::boxes_on_a_floor().to_obj();
    // Inside a vertex; and vertices lost before the faces that use them.
    refused("cut.obj", &whole[..whole.find("v 6 0").expect("a vertex") + 5], &["cut.obj:"]);
    refused("cut.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 9\n", &["cut.obj:4", "out of bounds"]);
}

#[test]
fn truncated_gltf() {
    let folder = empty_folder();
    Mesh::boxes_on_a_floor().write_gltf(folder.path(), "whole");
    let text = std::fs::read(folder.path().join("whole.gltf")).expect("read");
    refused("cut.gltf", &text[..text.len() / 2], &["EOF"]);
    refused("cut.glb", b"glTF\x02\0\0\0\xff", &["cut.glb"]);
    // The text is whole, its buffer is not.
    let buffer = folder.path().join("whole.bin");
    let bytes = std::fs::read(&buffer).expect("read");
    std::fs::write(&buffer, &bytes[..bytes.len() / 2]).expect("cut");
    evaluate(folder.path(), "whole.gltf").ended_with(4).says("whole.gltf");
    std::fs::remove_file(&buffer).expect("removed");
    evaluate(folder.path(), "whole.gltf").ended_with(4).says("whole.");
}

#[test]
fn truncated_toml() {
    let whole = scene_toml(SUN, DOLLY);
    let folder = folder_with_scene();
    for cut in ["width_wor", "motion = { kind = \"dol", "[[pa"] {
        let end = whole.find(cut).expect("in the file") + cut.len();
        std::fs::write(folder.path().join("cut.toml"), &whole[..end]).expect("written");
        let line = whole[..end].lines().count();
        evaluate(folder.path(), "cut.toml").ended_with(4).says(&format!("cut.toml:{line}:"));
    }
    refused("suite.toml", "name = \"mine\"\n[[scene", &["line 2"]);
}

/// The field and its line are named: a misspelt setting must not be ignored.
#[test]
fn unknown_fields() {
    let folder = folder_with_scene();
    let whole = scene_toml(SUN, DOLLY);
    let cases = [
        ("title =", "titel = \"x\"\ntitle =", "titel"),
        ("elevation_degrees", "colour = 3\nelevation_degrees", "colour"),
        ("width_world", "height_world = 3.0\nwidth_world", "height_world"),
        ("name = \"P1\"", "name = \"P1\"\nfps = 60.0", "fps"),
    ];
    for (before, after, field) in cases {
        let text = whole.replacen(before, after, 1);
        let line = 1 + text.lines().position(|l| l.starts_with(field)).expect("there");
        std::fs::write(folder.path().join("odd.toml"), text).expect("written");
        let place = format!("odd.toml:{line}:");
        evaluate(folder.path(), "odd.toml")
            .ended_with(4)
            .says(&place)
            .says(&format!("unknown field `{field}`"));
    }
    refused("suite.toml", "name = \"mine\"\nsizes = [1, 2]\nscene = []\n", &["line 2", "sizes"]);
}

#[test]
fn vertices_that_are_no_numbers() {
    for word in ["nan", "inf", "-inf", "1e999"] {
        let text = format!("v 0 0 0\nv 1 {word} 0\nv 0 0 1\nf 1 2 3\n");
        refused("odd.obj", text, &["vertex 1", "not finite"]);
    }
    let folder = empty_folder();
    let mut mesh = Mesh::boxes_on_a_floor();
    mesh.positions[5][1] = f32::NAN;
    mesh.write_gltf(folder.path(), "odd");
    evaluate(folder.path(), "odd.gltf").ended_with(4).says("vertex 5").says("not finite");
}

#[test]
fn models_without_triangles() {
    refused("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\n", &["no triangle"]);
    refused("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n", &["no triangle with an area"]);
    refused("empty.obj", "", &["no triangle"]);
    refused("empty.gltf", "{\"asset\": {\"version\": \"2.0\"}}", &["no triangle"]);
}

#[test]
fn degenerate_triangles_are_dropped_and_counted() {
    let folder = folder_with_scene();
    let mut text = Mesh::boxes_on_a_floor().to_obj();
    text.push_str("f 1 1 2\nf 1 2 2\nf 3 3 3\n");
    std::fs::write(folder.path().join("model.obj"), text).expect("written");
    evaluate(folder.path(), "scene.toml").ended_with(0).says("3 degenerate triangles dropped");
    let card = umbrage_tests::Card::load(&folder.path().join("run"));
    let notes = card.0["provenance"]["scenes"][0]["notes"].to_string();
    assert!(notes.contains("3 degenerate triangles dropped"), "{notes}");
}
