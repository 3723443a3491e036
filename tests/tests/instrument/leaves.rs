//! Scenes as users have them: a file from Blender, cut-out leaves, several lights.

use std::path::Path;
use umbrage_tests::{Card, DOLLY, Mesh, empty_folder, run, scene_toml, umbrage};

const SMALL: &str = "--size 160x90 --frames 4 --seeds 2 --samples 64 --map 1024 --out run --cache cache";

/// A folder with `models/leafy.glb`, as Blender's exporter wrote it (`peers/blender/leafy.py`).
fn leafy() -> tempfile::TempDir {
    let folder = empty_folder();
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/leafy.glb");
    std::fs::copy(model, folder.path().join("leafy.glb")).expect("copied");
    folder
}

/// Truth and raster see the same holes: where they did not, the hard shadow of a sun two degrees wide
/// would be wrong over whole leaves, not along their edges.
#[test]
fn a_file_from_blender_is_scored_as_it_is() {
    let folder = leafy();
    let line =
        format!("evaluate leafy.glb --path camera --variant hard --variant chss/light-matched {SMALL}");
    let ran = run(&mut umbrage(folder.path(), &line)).ended_with(0);
    assert!(!ran.stderr.contains("texture"), "{}", ran.stderr);
    let card = Card::load(&folder.path().join("run"));
    let error = |variant: &str| card.score("leafy camera", variant, "error").expect("measured").value;
    // A linear penumbra that is hard instead has an error of 1/sqrt(12), .29; a leaf that is whole where it
    // has a hole, or the other way round, has 1.
    let (hard, soft) = (error("hard/light-matched"), error("chss/light-matched"));
    assert!(hard < 0.45 && soft < hard, "hard {hard}, soft {soft}");
}

/// The GPU's truth knows no masks: it says so, and `auto` takes the CPU.
#[test]
fn truth_on_the_gpu_refuses_cut_outs() {
    let folder = leafy();
    let line = "reference leafy.glb --path camera --size 32x18 --samples 16 --out t.exr";
    let ran = run(&mut umbrage(folder.path(), &format!("{line} --reference-on gpu"))).ended_with(2);
    assert!(ran.stderr.contains("cut-out") && ran.stderr.contains("auto or cpu"), "{}", ran.stderr);
    run(&mut umbrage(folder.path(), line)).ended_with(0);
}

#[test]
fn each_light_is_scored_by_itself() {
    let folder = empty_folder();
    std::fs::write(folder.path().join("model.obj"), Mesh::boxes_on_a_floor().to_obj()).expect("written");
    let lights = "kind = \"sphere\"\ncentre = [0.8, 4.0, 1.0]\nradius_world = 0.4\n\n[[light]]\n\
                  kind = \"sun\"\nangular_diameter_degrees = 3.0\nelevation_degrees = 60.0\nazimuth_degrees = 20.0";
    std::fs::write(folder.path().join("two.toml"), scene_toml(lights, DOLLY)).expect("written");
    let line = format!("evaluate two.toml --light 1 --light 2 --variant hard/light-matched {SMALL}");
    run(&mut umbrage(folder.path(), &line)).ended_with(0);
    let card = Card::load(&folder.path().join("run"));
    let error = |window: &str| card.score(window, "hard/light-matched", "error").expect("measured").value;
    let (ball, sun) = (error("two.light-1 P1"), error("two.light-2 P1"));
    assert!(ball != sun, "two lights, one error: {ball}");

    // Without the flag it is the first, under the scene's own name.
    let line = format!("evaluate two.toml --variant hard/light-matched {SMALL}");
    let ran = run(&mut umbrage(folder.path(), &line)).ended_with(0);
    assert!(ran.stderr.contains("2 lights: number 1 is scored"), "{}", ran.stderr);
    let card = Card::load(&folder.path().join("run"));
    let first = card.score("two P1", "hard/light-matched", "error").expect("measured").value;
    // Patterns are salted by the window's name; a hard shadow has none.
    assert_eq!(first, ball);

    let ran = run(&mut umbrage(folder.path(), "evaluate two.toml --light 3")).ended_with(2);
    assert!(ran.stderr.contains("numbered from 1 to 2"), "{}", ran.stderr);
}
