//! The prelude of a user's own technique and its page, docs/your-technique.md, say the same.

mod support;

use std::collections::BTreeSet;
use std::path::Path;
use support::still_life;
use umbrage_shadows::{Inputs, LightMap, Own, Pass, Projection, Receivers, Recording, Seeding, VariantId};

const BODY: &str = "//! name = \"mine\"\nfn shade(r: Receiver) -> f32 { return 1.0; }\n";

fn page() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/your-technique.md");
    std::fs::read_to_string(path).expect("the page")
}

/// Functions that the page promises, as signatures.
fn promised(page: &str) -> BTreeSet<String> {
    let rows = page.lines().filter_map(|l| l.strip_prefix("| `fn ")?.split_once('`'));
    rows.map(|(signature, _)| format!("fn {signature}")).collect()
}

/// WGSL of the last pass, for both kinds of light and of receiver.
fn modules(variant: VariantId) -> Vec<String> {
    let (scene, view) = (still_life::scene(), still_life::view_of(&still_life::camera()));
    let mut all = Vec::new();
    for light in still_life::lights_for(variant) {
        let map = LightMap::with(&scene, &light, (64, Projection::Single));
        for receivers in [Receivers::Frame, Receivers::Anchors { count: 1 }] {
            let inputs = Inputs {
                view: &view,
                light: &map,
                calibration: variant.calibration,
                bias: variant.calibration.default_bias(),
                receivers,
                seeding: Seeding::Fresh,
                geometry_key: 0,
                has_cutouts: false,
                past: &[],
                age: 0,
            };
            all.push(text_of(&inputs.recorded(variant, [0, 0])));
        }
    }
    all
}

fn text_of(recording: &Recording) -> String {
    let Some(Pass::Compute(last)) = recording.passes.last() else { panic!("no compute pass") };
    last.shader.iter().map(|f| f.source.as_ref()).collect::<Vec<_>>().join("\n")
}

fn signatures(wgsl: &str) -> BTreeSet<String> {
    wgsl.lines().filter(|l| l.starts_with("fn ")).map(|l| l.trim_end_matches(" {").to_string()).collect()
}

fn name_of(signature: &str) -> &str {
    signature.trim_start_matches("fn ").split('(').next().unwrap_or_default()
}

#[test]
fn every_promised_function_is_there_under_every_light() {
    let variant = Own::read("mine.wgsl", BODY.into()).expect("a header").into_variant().expect("valid");
    let promised = promised(&page());
    assert!(promised.len() > 20, "{promised:?}");
    for module in modules(variant) {
        let there = signatures(&module);
        let missing: Vec<_> = promised.difference(&there).collect();
        assert!(missing.is_empty(), "docs/your-technique.md promises {missing:#?}");
    }
}

/// Names that are neither promised nor listed as taken would surprise whoever uses them.
#[test]
fn every_function_is_on_the_page() {
    let page = page();
    let promised: BTreeSet<String> = promised(&page).iter().map(|s| name_of(s).to_string()).collect();
    let (_, internals) = page.split_once("may change:").expect("the internals");
    let internals = internals.split_once("\n\n").expect("a paragraph").0;
    let patterns = ["ign", "white", "world", "none"].map(|p| format!("//! pattern = \"{p}\"\n"));
    for header in patterns {
        let text = BODY.replacen('\n', &format!("\n{header}"), 1);
        let variant = Own::read("mine.wgsl", text).expect("a header").into_variant().expect("valid");
        for signature in modules(variant).iter().flat_map(|m| signatures(m)) {
            let name = name_of(&signature);
            let known =
                promised.contains(name) || internals.contains(&format!("`{name}`")) || name == "shade";
            assert!(known, "{name} is not on the page");
        }
    }
}

/// Every header's choice is a valid module, and the file is the first fragment: lines are its own.
#[test]
fn every_choice_of_the_header_is_valid() {
    for line in [
        "pattern = \"white\"",
        "pattern = \"world\"",
        "pattern = \"none\"",
        "kernel = \"poisson\"",
        "kernel = \"spiral\"",
        "calibration = \"as-printed\"",
        "lights = [\"local\"]",
        "constants = { half = 0.5, count = 3, far = -1e-7, many = 4294967295 }",
    ] {
        let text = BODY.replacen('\n', &format!("\n//! {line}\n"), 1);
        let own = Own::read("mine.wgsl", text.clone()).unwrap_or_else(|e| panic!("{line}: {e}"));
        let variant = own.into_variant().unwrap_or_else(|e| panic!("{line}: {e}"));
        assert!(modules(variant)[0].starts_with(&text), "{line}");
    }
}

/// An abstract constant is what the place where it is used asks for.
#[test]
fn constants_take_the_type_of_their_place() {
    let text = "//! name = \"mine\"\n//! constants = { count = 3, half = 0.5 }\n\
                fn shade(r: Receiver) -> f32 {\n    var all: array<f32, count>;\n    let a: u32 = count;\n    \
                let b: i32 = count;\n    let c: f32 = count;\n    for (var i = 0u; i < count; i++) { all[i] = half; }\n    \
                return f32(a) + f32(b) + c * all[0];\n}\n";
    let checked = Own::read("mine.wgsl", text.into()).expect("a header").into_variant();
    checked.map(|_| ()).unwrap_or_else(|e| panic!("{e}"));
}

/// Lines end in two bytes on some systems: places are counted in the file as it is.
#[test]
fn places_are_the_files_own_with_either_line_ending() {
    let text = "// mine\n\n//! name = \"mine\"\n//! # \u{e9}\u{e9}\n//! taps = 3\n";
    for text in [text.to_string(), text.replace('\n', "\r\n"), format!("\u{feff}{text}")] {
        let refused = Own::read("mine.wgsl", text).map(|_| ()).expect_err("no such key").to_string();
        assert!(refused.starts_with("mine.wgsl:5:5: unknown field `taps`"), "{refused}");
    }
}

#[test]
fn every_file_on_the_page_is_valid() {
    let page = page();
    let files: Vec<&str> = page.split("```wgsl\n").skip(1).filter_map(|b| b.split("```").next()).collect();
    assert!(files.len() >= 2, "{files:?}");
    for file in files {
        let checked = Own::read("mine.wgsl", file.into()).and_then(Own::into_variant);
        checked.map(|_| ()).unwrap_or_else(|e| panic!("{file}\n{e}"));
    }
}
