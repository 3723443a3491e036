//! Scenes that are well written and odd: lights and cameras in the wrong place, pictures of one
//! pixel, paths of one frame.

use std::path::Path;
use umbrage_frame::read_exr;
use umbrage_tests::{Card, DOLLY, Mesh, Ran, SUN, folder_with_scene, run, scene_toml, umbrage};

const FLAGS: &str = "--size 64x36 --seeds 2 --samples 16 --map 128 --out run";
const WINDOW: &str = "by-hand P1";

/// Evaluates a scene of this light and motion.
fn evaluate(folder: &Path, (light, motion): (&str, &str), flags: &str) -> Ran {
    std::fs::write(folder.join("by-hand.toml"), scene_toml(light, motion)).expect("written");
    run(&mut umbrage(folder, &format!("evaluate by-hand.toml {FLAGS} {flags}")))
}

const SHORT: &str = "--frames 2 --variant hard";

fn sphere(centre: [f32; 3]) -> String {
    format!("kind = \"sphere\"\ncentre = {centre:?}\nradius_world = 0.02")
}

/// Says so, exits 3, and still leaves pages with pictures that show why.
#[track_caller]
fn scores_nothing(folder: &Path, ran: Ran) {
    ran.ended_with(3).says("nothing could be scored").says("help:");
    // It is no baseline, either.
    run(&mut umbrage(folder, "accept run --name main")).ended_with(3).says("nothing to compare with");
    assert!(!folder.join("reports/baselines").exists());
    for page in ["index.html", "scorecard.json", "scores.csv", "summary.md", "junit.xml"] {
        assert!(folder.join("run").join(page).exists(), "{page}");
    }
    let card = Card::load(&folder.join("run"));
    assert_eq!(card.windows()[0]["anchors"], 0);
    for (_, _, scores) in card.results() {
        for (metric, score) in scores.as_object().expect("scores") {
            // A score that nobody took is never a number. Pictures that are equal because nothing is
            // counted in them are the exception that SSIM and FLIP may make.
            let pictures = ["flip", "ssim"].contains(&metric.as_str());
            assert!(pictures || score.get("not_measured").is_some(), "{metric}: {score}");
        }
    }
}

#[test]
fn a_sun_below_the_horizon_of_everything() {
    let folder = folder_with_scene();
    // Only a floor: from below, no box shows an underside.
    let mut floor = Mesh::default();
    floor.quad([[-6.0, 0.0, -6.0], [-6.0, 0.0, 6.0], [6.0, 0.0, 6.0], [6.0, 0.0, -6.0]]);
    std::fs::write(folder.path().join("model.obj"), floor.to_obj()).expect("written");
    let below = SUN.replace("= 50.0", "= -50.0");
    let ran = evaluate(folder.path(), (&below, DOLLY), SHORT).says("below the horizon");
    scores_nothing(folder.path(), ran);
}

#[test]
fn a_camera_that_sees_nothing() {
    let folder = folder_with_scene();
    let away = "kind = \"still\", eye = [0.0, 3.0, 6.0], target = [0.0, 30.0, 60.0]";
    let ran = evaluate(folder.path(), (SUN, away), "--frames 2");
    scores_nothing(folder.path(), ran);
}

/// Everything it sees is umbra: the leak is measured, and the cells, which need a penumbra, are not.
#[test]
fn a_camera_inside_a_closed_box() {
    let folder = folder_with_scene();
    let mut mesh = Mesh::default();
    mesh.cuboid([-1.0, 0.0, -1.0], [1.0, 1.0, 1.0]);
    std::fs::write(folder.path().join("model.obj"), mesh.to_obj()).expect("written");
    let inside = "kind = \"still\", eye = [0.0, 0.5, 0.5], target = [0.3, 0.0, -1.0]";
    evaluate(folder.path(), (SUN, inside), SHORT).ended_with(0).says("starts inside a solid");
    let card = Card::load(&folder.path().join("run"));
    let variant = "hard/light-matched";
    assert_eq!(card.why_not(WINDOW, variant, "error").as_deref(), Some("no penumbra in this view"));
    let leak = card.score(WINDOW, variant, "light_leak").expect("the umbra is measured");
    // A map texel is 8 cm wide: within one of an edge of the lid, and nowhere else, light gets in.
    assert!(leak.value < 0.05, "{leak:?}");
}

/// Its surroundings are its own shadow; that is said, not refused.
#[test]
fn a_light_inside_a_box() {
    let folder = folder_with_scene();
    let ran = evaluate(folder.path(), (&sphere([-0.2, 1.05, 0.0]), DOLLY), SHORT);
    ran.ended_with(0).says("light 1 lies inside a solid");
    let card = Card::load(&folder.path().join("run"));
    let notes = card.0["provenance"]["scenes"][0]["notes"].to_string();
    assert!(notes.contains("inside a solid"), "{notes}");
}

/// A hard shadow in truth as well: each point sees all of the light or nothing of it.
#[test]
fn a_light_without_size() {
    let folder = folder_with_scene();
    for light in [SUN.replace("= 2.0", "= 0.0"), sphere([0.5, 4.0, 1.0]).replace("0.02", "0.0")] {
        evaluate(folder.path(), (&light, DOLLY), SHORT).ended_with(0);
        let card = Card::load(&folder.path().join("run"));
        let why = card.why_not(WINDOW, "hard/light-matched", "error");
        assert_eq!(why.as_deref(), Some("no penumbra in this view"));
        let reference = "reference by-hand.toml --size 64x36 --samples 64 --out truth.exr";
        run(&mut umbrage(folder.path(), reference)).ended_with(0);
        let layers = read_exr(&folder.path().join("truth.exr")).expect("written");
        let truth = &layers.iter().find(|l| l.0 == "reference.V").expect("V").1;
        let shares = [0.0, 1.0].map(|v| truth.pixels().iter().filter(|p| **p == v).count());
        assert_eq!(shares[0] + shares[1], truth.pixels().len(), "a grey point under a light without size");
        assert!(shares[0] > 20 && shares[1] > 20, "shadow and light are both seen: {shares:?}");
    }
}

#[test]
fn a_picture_of_one_pixel() {
    let folder = folder_with_scene();
    evaluate(folder.path(), (SUN, DOLLY), SHORT).ended_with(0);
    let line = "evaluate by-hand.toml --size 1x1 --frames 2 --seeds 2 --samples 16 --map 64 --out one";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    let card = Card::load(&folder.path().join("one"));
    assert_eq!((&card.0["provenance"]["width"], &card.0["provenance"]["height"]), (&1.into(), &1.into()));
    assert!(folder.path().join("one/index.html").exists());
}

/// What moves cannot be seen in one frame: "not measured", never 0.
#[test]
fn a_path_of_one_frame() {
    let folder = folder_with_scene();
    evaluate(folder.path(), (SUN, DOLLY), "--frames 1 --variant hard --variant chss").ended_with(0);
    let card = Card::load(&folder.path().join("run"));
    for variant in card.variants() {
        assert!(card.score(WINDOW, &variant, "error").is_some(), "{variant}: a still has an error");
        for metric in ["swimming", "smooth_moving", "structured_moving", "von_neumann", "edge_crawl"] {
            let why = card.why_not(WINDOW, &variant, metric);
            assert_eq!(why.as_deref(), Some("one frame only"), "{variant}, {metric}");
        }
    }
    let chss = "chss/light-matched";
    let why = card.why_not(WINDOW, chss, "lag1_point_frozen");
    assert_eq!(why.as_deref(), Some("one frame only"));
    for result in card.0["results"].as_array().expect("results") {
        assert_eq!(result["per_frame_swimming"], serde_json::json!([]));
        assert_eq!(result["groups"].get("swimming").and_then(|g| g.as_str()).unwrap_or(""), "");
    }
    let compared = card.0["paired"].as_array().expect("pairs").iter();
    assert_eq!(compared.filter(|p| p["metric"] == "swimming").count(), 0, "a difference of two nothings");
    let csv = std::fs::read_to_string(folder.path().join("run/scores.csv")).expect("read");
    let swims: Vec<&str> = csv.lines().filter(|l| l.contains(",swimming,")).collect();
    assert!(!swims.is_empty() && swims.iter().all(|l| l.contains(",swimming,,,,")), "{swims:?}");
}
