//! Local lights: a disk, a rectangle and a sphere over a hand-written model.

use umbrage_tests::{Card, DOLLY, Mesh, empty_folder, run, scene_toml, umbrage};

const LIGHTS: [(&str, &str); 3] = [
    ("disk", "kind = \"disk\"\ncentre = [0.8, 4.0, 1.0]\nnormal = [0.1, -1.0, 0.0]\nradius_world = 0.4"),
    ("rect", "kind = \"rect\"\ncentre = [0.8, 4.0, 1.0]\nhalf_u = [0.5, 0.0, 0.0]\nhalf_v = [0.0, 0.0, 0.3]"),
    ("sphere", "kind = \"sphere\"\ncentre = [0.8, 4.0, 1.0]\nradius_world = 0.4"),
];

/// Contact hardening that knows the light is nearer the truth than a hard shadow, resolved.
#[test]
fn local_lights_are_scored_and_contact_hardening_helps() {
    let folder = empty_folder();
    std::fs::write(folder.path().join("model.obj"), Mesh::boxes_on_a_floor().to_obj()).expect("written");
    for (name, light) in LIGHTS {
        std::fs::write(folder.path().join(format!("{name}.toml")), scene_toml(light, DOLLY))
            .expect("written");
    }
    let line = "evaluate disk.toml rect.toml sphere.toml --variant hard --variant chss/light-matched \
                --size 160x90 --frames 4 --seeds 2 --samples 128 --map 1024 --out run --cache cache";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    let card = Card::load(&folder.path().join("run"));
    for (name, _) in LIGHTS {
        let window = format!("{name} P1");
        let better = card.paired(&window, ("hard/light-matched", "chss/light-matched"), "error");
        assert!(better.low > 0.0, "{name}: hard minus chss {better:?}");
        // The contact hardening of a small light must be close, not merely better: a wrong unit of
        // the light's size would still beat a hard edge. 0.15 is a third of what a hard edge has in
        // a linear penumbra (1/sqrt(12) = 0.29), doubled for blockers that one search mixes.
        let error = card.score(&window, "chss/light-matched", "error").expect("measured").value;
        assert!(error < 0.2, "{name}: {error}");
        let swims = card.score(&window, "hard/light-matched", "swimming").expect("measured").value;
        assert!(swims.abs() < 1e-30, "{name}: {swims}");
    }
}
