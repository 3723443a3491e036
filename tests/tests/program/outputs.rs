//! What a run leaves behind, and what it prints.

use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use umbrage_tests::{Card, Ran, folder_with_scene, run, umbrage};

/// Every variant, two frames.
const SMALL: &str =
    "evaluate scene.toml --size 64x36 --frames 2 --seeds 2 --samples 32 --map 256 --out run --cache cache";

const PAGES: [&str; 5] = ["index.html", "scorecard.json", "scores.csv", "summary.md", "junit.xml"];

/// One run serves the whole file: the tests below are the parts of a story.
#[test]
fn a_run_prints_its_scorecard_and_leaves_every_page() {
    let folder = folder_with_scene();
    let ran = run(&mut umbrage(folder.path(), &format!("{SMALL} --json"))).ended_with(0);
    let out = folder.path().join("run");
    let card = only_the_scorecard_is_printed(&ran, &out);
    every_page_is_there(&out, &card);
    the_shape_of_the_scorecard_is_as_committed(&card);
    pages_can_be_made_again(folder.path());
}

/// Truth within a tolerance says for each window what was reached.
#[test]
fn a_run_says_what_its_truth_reached() {
    let folder = folder_with_scene();
    let line = "evaluate scene.toml --size 64x36 --frames 1 --seeds 2 --samples 32 --tolerance 0.01 --map 256 \
                --variant hard --out run --cache cache";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    let card = std::fs::read_to_string(folder.path().join("run/scorecard.json")).expect("stored");
    assert!(card.contains("truth within 0.01: its standard error is"), "{card}");
}

fn only_the_scorecard_is_printed(ran: &Ran, out: &Path) -> Card {
    let printed: Value = serde_json::from_str(&ran.stdout).expect("standard output is one JSON value");
    let stored = std::fs::read_to_string(out.join("scorecard.json")).expect("stored");
    assert_eq!(ran.stdout.trim_end(), stored.trim_end(), "printed and stored are the same text");
    assert!(ran.stderr.contains("adapter: "), "what is running goes to standard error");
    Card(printed)
}

fn every_page_is_there(out: &Path, card: &Card) {
    for page in PAGES {
        let bytes = std::fs::metadata(out.join(page)).unwrap_or_else(|e| panic!("{page}: {e}")).len();
        assert!(bytes > 0, "{page}");
    }
    let read = |page: &str| std::fs::read_to_string(out.join(page)).expect("text");
    let page = read("index.html");
    // Opens from a disk without network: nothing is loaded from elsewhere.
    for outside in ["src=\"http", "href=\"http", "url(http", "@import"] {
        assert!(!page.contains(outside), "the page loads {outside}");
    }
    let summary = read("summary.md");
    assert!(summary.len() < 1 << 20, "a CI step summary holds 1 MiB");
    let (csv, junit) = (read("scores.csv"), read("junit.xml"));
    for variant in card.variants() {
        let (name, calibration) = variant.split_once('/').expect("name/calibration");
        // A scene.toml is named after its folder, here a temporary one.
        assert!(csv.contains(&format!(",{name},{calibration},error,")), "{variant} has no row in scores.csv");
        for text in [&page, &summary, &junit] {
            assert!(text.contains(name), "{variant} is not on every page");
        }
    }
}

/// Keys, metrics and variants, without numbers. After a deliberate change:
/// `UMBRAGE_BLESS=1 cargo test -p umbrage-tests --test program`.
fn the_shape_of_the_scorecard_is_as_committed(card: &Card) {
    let mut lines = BTreeSet::new();
    shape(&card.0, "", &mut lines);
    let ids = card.0["metrics"].as_array().expect("metrics").iter();
    lines.extend(ids.map(|m| format!("metric {}", m["id"].as_str().expect("an id"))));
    lines.extend(card.variants().iter().map(|v| format!("variant {v}")));
    let found = lines.into_iter().collect::<Vec<_>>().join("\n") + "\n";
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/program/scorecard.shape.txt");
    if std::env::var_os("UMBRAGE_BLESS").is_some() {
        std::fs::write(&path, &found).expect("written");
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    let differs = found.lines().find(|line| !committed.lines().any(|c| c == *line));
    let lost = committed.lines().find(|line| !found.lines().any(|f| f == *line));
    assert!(
        differs.is_none() && lost.is_none(),
        "the scorecard's shape has changed (new: {differs:?}, lost: {lost:?}); if that is meant, \
         raise SCHEMA_VERSION unless a field was only added, and run UMBRAGE_BLESS=1 cargo test -p umbrage-tests --test program"
    );
}

fn shape(value: &Value, place: &str, lines: &mut BTreeSet<String>) {
    let kind = match value {
        // A real adapter has costs, a software one a note.
        _ if place.starts_with(".overall[].cost") => "depends on the adapter",
        Value::Object(fields) if fields.contains_key("not_measured") => "score or not measured",
        Value::Object(fields) if fields.contains_key("low") => match place {
            _ if place.contains(".scores.") => "score or not measured",
            _ => "score",
        },
        Value::Object(fields) => {
            return fields.iter().for_each(|(key, field)| shape(field, &format!("{place}.{key}"), lines));
        }
        Value::Array(items) => {
            items.iter().for_each(|item| shape(item, &format!("{place}[]"), lines));
            "list"
        }
        Value::Null => "may be null",
        Value::Bool(_) => "true or false",
        Value::Number(_) => "number",
        Value::String(_) => "text",
    };
    // Which notes there are depends on the scene.
    if !place.ends_with("notes[]") {
        lines.insert(format!("{place}: {kind}"));
    }
}

fn pages_can_be_made_again(folder: &Path) {
    let read = || PAGES.map(|page| std::fs::read(folder.join("run").join(page)).expect("a page"));
    let before = read();
    for page in PAGES.iter().filter(|page| **page != "scorecard.json") {
        std::fs::remove_file(folder.join("run").join(page)).expect("removed");
    }
    let ran = run(&mut umbrage(folder, "report run")).ended_with(0);
    assert!(ran.stdout.contains("index.html"), "{}", ran.stdout);
    for (page, (before, after)) in PAGES.iter().zip(before.iter().zip(read())) {
        assert!(*before == after, "{page} is not the same bytes");
    }
    run(&mut umbrage(folder, "report run --report dir")).ended_with(0);
    assert!(
        !umbrage_tests::files_below(&folder.join("run/index_files")).is_empty(),
        "pictures beside the page"
    );
}

#[test]
fn a_run_without_a_scorecard_has_no_report() {
    let folder = folder_with_scene();
    run(&mut umbrage(folder.path(), "report nowhere")).ended_with(4).says("nowhere");
    std::fs::create_dir(folder.path().join("broken")).expect("made");
    std::fs::write(folder.path().join("broken/scorecard.json"), "{\"schema_version\": 1,").expect("written");
    run(&mut umbrage(folder.path(), "report broken")).ended_with(4).says("scorecard.json");
}
