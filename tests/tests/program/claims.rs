//! `umbrage claims`: verdicts from a small registry, taken up again from the cache.

use serde_json::Value;
use std::path::Path;
use umbrage_tests::{empty_folder, run, umbrage};

/// Two claims and an exact one, over a scene of the standard suite.
const SMALL: &str = r#"
[margin]
error = { ratio = 0.05, absolute = 0.002 }
noise = { ratio = 0.1, absolute = 0.0 }
differing = { absolute = 0.0 }
vogel_radii = { absolute = 1e-6 }

[[claim]]
id = "C1"
document = "a <test>"
statement = "Rotation | makes <b>noise</b>."
part = [
  { says = "noise", a = "pcf-vogel-16-ign", b = "pcf-vogel-16", number = "noise", places = ["edge-ladder/P1"], expect = "above", margin = 0.0, why = "any" },
  { says = "a variant that nobody wrote", a = "moonshine", b = "hard", number = "error", places = ["edge-ladder/P1"], expect = "below" },
]

[[claim]]
id = "C2"
document = "a test"
statement = "A variant is itself."
part = [
  { says = "bit for bit", a = "chss", b = 0.0, number = "differing", against = "chss", places = ["edge-ladder/P1"], expect = "equal" },
  { says = "another map is another error", a = { variant = "hard", at = { map = 64 } }, b = "hard", number = "error", places = ["edge-ladder/P1"], expect = "equal", margin = 0.0, why = "any" },
]

[[claim]]
id = "C3"
document = "a test"
statement = "Radii differ."
part = [{ says = "exactly", number = "vogel_radii", b = 0.0, expect = "above" }]
"#;

const FLAGS: &str =
    "--registry small.toml --size 96x54 --seeds 2 --samples 32 --map 512 --cache cache --json";

fn claims(folder: &Path, flags: &str) -> Value {
    let ran = run(&mut umbrage(folder, &format!("claims {flags}"))).ended_with(0);
    serde_json::from_str(&ran.stdout).expect("standard output is one JSON value")
}

fn verdict<'a>(card: &'a Value, id: &str) -> &'a str {
    let claims = card["claims"].as_array().expect("claims");
    let found = claims.iter().find(|c| c["id"] == id).expect("a claim of that id");
    found["verdict"].as_str().expect("a verdict")
}

#[test]
fn claims_are_judged_and_a_second_run_takes_up_the_first() {
    let folder = empty_folder();
    std::fs::write(folder.path().join("small.toml"), SMALL).expect("written");
    let first = claims(folder.path(), &format!("{FLAGS} --out one --publish reports"));
    assert_eq!(verdict(&first, "C1"), "holds", "{first:#}");
    assert_eq!(verdict(&first, "C2"), "holds_partly", "a coarse map has another error");
    assert_eq!(verdict(&first, "C3"), "holds");
    let missing = &first["claims"][0]["parts"][1];
    assert_eq!(missing["outcome"], "not_measured");
    assert!(missing["reason"].as_str().expect("a reason").contains("moonshine"));
    every_page_is_there(folder.path());
    let units = || std::fs::read_dir(folder.path().join("cache/claims")).expect("a cache").count();
    let stored = units();
    let second = claims(folder.path(), &format!("{FLAGS} --out two"));
    assert_eq!(first["claims"], second["claims"], "the same numbers, from the cache");
    assert_eq!(units(), stored);
}

fn every_page_is_there(folder: &Path) {
    let read =
        |name: &str| std::fs::read_to_string(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    let page = read("one/index.html");
    assert!(page.contains("Rotation | makes &lt;b&gt;noise&lt;/b&gt;.") && !page.contains("<b>"));
    assert!(page.contains("Holds partly") && page.contains("data:image/png;base64,"));
    for outside in ["src=\"http", "href=\"http", "url(http", "@import", "<script"] {
        assert!(!page.contains(outside), "the page has {outside}");
    }
    assert!(read("one/claims.md").contains("Rotation \\| makes &lt;b&gt;"));
    assert_eq!(read("one/claims.md"), read("reports/claims.md"), "published as it is");
    for name in ["one/claims/C01.png", "reports/claims/C01.png"] {
        let bytes = std::fs::metadata(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}")).len();
        assert!(bytes < 25_000, "{name} has {bytes} bytes");
    }
}

#[test]
fn an_unknown_claim_is_named_with_those_that_exist() {
    let folder = empty_folder();
    let ran = run(&mut umbrage(folder.path(), "claims C7 C99")).ended_with(2);
    assert!(ran.stderr.contains("\"C99\"") && ran.stderr.contains("C40"), "{}", ran.stderr);
}

#[test]
fn a_cost_without_a_gpu_says_so_and_committed_costs_are_taken() {
    let folder = empty_folder();
    let card = claims(folder.path(), "C24 --out run --cache cache --json --cost-size 64x36");
    if card["provenance"]["adapter"]["is_cpu"] != true {
        assert!(card["provenance"]["costs"].is_object(), "a GPU is timed");
        return;
    }
    assert_eq!(verdict(&card, "C24"), "needs_gpu");
    let entry = |variant: &str, ms: f64| {
        format!(
            r#"{{"place":"colonnade P1","variant":"{variant}/light-matched","passes":[],"kept":[["min-filter",0.5]],
            "frames":[{ms},{ms},{ms}],"frame_passes":[[],[],[]]}}"#
        )
    };
    let book = format!(
        r#"{{"origin":{{"adapter":"Some GPU","driver":"1","width":64,"height":36,"shadow_map_texels":2048,"date":"d","command":"c"}},
        "entries":[{},{}]}}"#,
        entry("chss-min", 2.0),
        entry("chss-mask", 1.0)
    );
    std::fs::create_dir_all(folder.path().join("reports/gpu")).expect("made");
    std::fs::write(folder.path().join("reports/gpu/claims-cost.json"), book).expect("written");
    let card = claims(folder.path(), "C24 --out run --cache cache --json");
    assert_eq!(verdict(&card, "C24"), "holds");
    assert_eq!(card["provenance"]["costs"]["adapter"], "Some GPU");
}

#[test]
fn a_registry_that_makes_no_sense_is_refused_with_the_place() {
    let folder = empty_folder();
    std::fs::write(folder.path().join("bad.toml"), SMALL.replace("\"noise\", places", "\"beauty\", places"))
        .expect("written");
    let ran = run(&mut umbrage(folder.path(), "claims --registry bad.toml")).ended_with(4);
    assert!(ran.stderr.contains("beauty") && ran.stderr.contains("C1"), "{}", ran.stderr);
}
