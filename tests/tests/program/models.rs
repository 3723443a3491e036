//! A model that nobody prepared: a bare OBJ or glTF is evaluated with no configuration, and the
//! scene file that was made for it lies beside the report.

use std::path::Path;
use umbrage_tests::{Card, Mesh, empty_folder, run, umbrage};

const FLAGS: &str = "--variant chss --size 96x54 --frames 2 --seeds 2 --samples 32 --map 256 --cache cache";

fn evaluate(folder: &Path, file: &str, out: &str) -> Card {
    run(&mut umbrage(folder, &format!("evaluate {file} {FLAGS} --out {out}"))).ended_with(0);
    assert!(folder.join(out).join("index.html").exists());
    Card::load(&folder.join(out))
}

/// Errors of all results, without the names of scenes.
fn errors(card: &Card) -> Vec<String> {
    card.results().iter().map(|(_, variant, scores)| format!("{variant} {}", scores["error"])).collect()
}

#[test]
fn bare_models_need_no_configuration() {
    let folder = empty_folder();
    let mesh = Mesh::boxes_on_a_floor();
    std::fs::write(folder.path().join("boxes.obj"), mesh.to_obj()).expect("written");
    mesh.write_gltf(folder.path(), "boxes");
    let from_obj = evaluate(folder.path(), "boxes.obj", "run-obj");
    let from_gltf = evaluate(folder.path(), "boxes.gltf", "run-gltf");
    let paths: Vec<&str> = from_obj.windows().iter().filter_map(|w| w["path"].as_str()).collect();
    assert_eq!(paths, ["P1", "P4"], "towards the model, and low over its floor");
    // The fitted cameras look at the model: much is seen, and some of it in half shadow.
    for window in from_obj.windows() {
        assert!(window["anchors"].as_u64() > Some(96 * 54 / 4), "{window}");
        assert!(window["tiles"].as_u64() > Some(0), "{window}");
    }
    // Two files of the same shape are the same scene, to the last bit of every error.
    assert_eq!(errors(&from_obj), errors(&from_gltf));
}

#[test]
fn the_scene_file_of_a_bare_model_is_a_scene() {
    let folder = empty_folder();
    std::fs::create_dir(folder.path().join("models")).expect("made");
    let mesh = Mesh::boxes_on_a_floor();
    std::fs::write(folder.path().join("models/boxes.obj"), mesh.to_obj()).expect("written");
    mesh.write_gltf(&folder.path().join("models"), "boxes");
    for model in ["models/boxes.obj", "models/boxes.gltf"] {
        let first = evaluate(folder.path(), model, "run");
        // Where it was written, and moved elsewhere, as a user would who edits it.
        std::fs::create_dir_all(folder.path().join("mine")).expect("made");
        std::fs::copy(folder.path().join("run/scene.toml"), folder.path().join("mine/scene.toml"))
            .expect("kept");
        for file in ["run/scene.toml", "mine"] {
            let again = evaluate(folder.path(), file, "again");
            assert_eq!(errors(&first), errors(&again), "{model} through {file}");
        }
    }
}

#[test]
fn several_models_and_a_suite_file() {
    let folder = empty_folder();
    let mesh = Mesh::boxes_on_a_floor();
    std::fs::create_dir(folder.path().join("suite")).expect("made");
    for name in ["one", "two"] {
        std::fs::write(folder.path().join(format!("suite/{name}.obj")), mesh.to_obj()).expect("written");
    }
    let suite = "name = \"mine\"\nsize = [48, 27]\n[[scene]]\nname = \"one.obj\"\npaths = [\"P1\"]\n\
                 [[scene]]\nname = \"two.obj\"\n";
    std::fs::write(folder.path().join("suite/mine.toml"), suite).expect("written");
    let line = "evaluate suite/mine.toml --variant hard --frames 2 --samples 16 --map 64 --out run";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    let card = Card::load(&folder.path().join("run"));
    let windows: Vec<String> =
        card.windows().iter().map(|w| format!("{} {}", w["scene"], w["path"])).collect();
    assert_eq!(windows, ["\"one\" \"P1\"", "\"two\" \"P1\"", "\"two\" \"P4\""]);
    assert_eq!(card.0["provenance"]["width"], 48);
    assert_eq!(card.0["provenance"]["suite"], "mine");
}
