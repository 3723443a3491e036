//! A technique of the user's own: scored like any other, and refused at the user's own line.

use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;
use umbrage_tests::{Card, Ran, folder_with_scene, run, umbrage};

const SMALL: &str =
    "evaluate scene.toml --size 64x36 --frames 2 --seeds 2 --samples 16 --map 256 --reference-on cpu";

/// The body of `pcf-vogel-16-ign`.
const PCF: &str = "//! name = \"mine\"
//! title = \"mine\"
//! filter_taps = 16
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    return filter_disc(s, fixed_radius_uv(s.depth), TAU * pattern(r.place, r.position));
}
";

/// The body of `hard`, with a constant.
const HARD: &str = "//! name = \"mine\"
//! stochastic = false
//! pattern = \"none\"
//! lights = [\"sun\"]
//! [constants]
//! moved_texels = 0.0
//! shift = 0
fn shade(r: Receiver) -> f32 {
    let s = shadow_point(r.position, r.normal);
    return lit_nearest(s, vec2(uv_from_texels(moved_texels + f32(shift)), 0.0));
}
";

fn folder_with(text: &str) -> TempDir {
    let folder = folder_with_scene();
    std::fs::write(folder.path().join("mine.wgsl"), text).expect("written");
    folder
}

fn evaluate(folder: &Path, more: &str) -> Ran {
    run(&mut umbrage(folder, &format!("{SMALL} --cache cache --out run --technique mine.wgsl {more}")))
}

/// What a file comes to that must not be scored.
fn refused(text: &str, code: i32, words: &[&str]) {
    let folder = folder_with(text);
    let ran = evaluate(folder.path(), "--variant hard/light-matched").ended_with(code);
    words.iter().fold(ran, |ran, words| ran.says(words));
    assert!(!folder.path().join("run/scorecard.json").exists(), "a run was stored");
}

fn scores(card: &Card, variant: &str) -> Vec<Value> {
    let results = card.results().into_iter().filter(|(_, name, _)| name == variant);
    let found: Vec<Value> = results.map(|(.., scores)| scores.clone()).collect();
    assert!(!found.is_empty(), "{variant} has no result");
    found
}

/// The identity is exact: the same text in the same pass.
#[test]
fn a_builtins_body_scores_as_the_builtin_does() {
    for (text, builtin) in [(PCF, "pcf-vogel-16-ign"), (HARD, "hard")] {
        let folder = folder_with(text);
        evaluate(folder.path(), &format!("--variant {builtin}/light-matched")).ended_with(0);
        let card = Card::load(&folder.path().join("run"));
        let (own, theirs) =
            (scores(&card, "mine/light-matched"), scores(&card, &format!("{builtin}/light-matched")));
        assert_eq!(own, theirs, "{builtin}");
    }
}

#[test]
fn constants_are_settings_and_part_of_what_is_cached() {
    let folder = folder_with(HARD);
    let error = |set: &str| {
        evaluate(folder.path(), &format!("--variant hard/light-matched {set}")).ended_with(0);
        let card = Card::load(&folder.path().join("run"));
        let settings = card.0["variants"][1]["settings"]["more"].clone();
        (settings, scores(&card, "mine/light-matched"))
    };
    let (settings, plain) = error("");
    assert_eq!(settings["constant moved_texels"], "0.0");
    let (settings, moved) = error("--set mine.moved_texels=3 --set mine.shift=-1");
    assert_eq!(
        (&settings["constant moved_texels"], &settings["constant shift"]),
        (&"3.0".into(), &"-1".into())
    );
    assert_ne!(plain, moved);
    // Cached results are told apart: the first again.
    assert_eq!(error("").1, plain);
}

/// As the gate's commands to copy name it.
#[test]
fn a_technique_may_be_named_as_a_variant() {
    let folder = folder_with(HARD);
    for name in ["mine", "mine/light-matched"] {
        evaluate(folder.path(), &format!("--variant {name}")).ended_with(0);
        assert_eq!(Card::load(&folder.path().join("run")).variants(), ["mine/light-matched"]);
    }
}

#[test]
fn settings_that_do_not_fit_are_usage() {
    let folder = folder_with(HARD);
    for (set, words) in [
        ("mine.moved=1", "no constant \"moved\""),
        ("mine.shift=0.5", "no whole number"),
        ("mine.moved_texels=wide", "no number"),
        ("mine.filter_taps=0", "0 taps"),
        ("yours.shift=1", "\"yours\""),
        ("shift", "NAME.CONSTANT=VALUE"),
    ] {
        evaluate(folder.path(), &format!("--set {set}")).ended_with(2).says(words);
    }
}

#[test]
fn wgsl_is_refused_at_the_users_line() {
    let at = |from: &str, to: &str| PCF.replace(from, to);
    refused(&at("r.normal);", "r.normal;"), 4, &["mine.wgsl:5:", "expected"]);
    refused(&at("filter_disc(", "filter_disk("), 4, &["mine.wgsl:6:12:", "filter_disk"]);
    refused(&at("return filter_disc(s,", "return filter_disc(2u,"), 4, &["mine.wgsl:6:"]);
    refused(&at("return ", "discard; return "), 4, &["mine.wgsl:6:", "forbidden at this stage"]);
    refused(&at("fn shade", "fn shadow"), 4, &["mine.wgsl:4:", "fn shade(r: Receiver) -> f32"]);
    refused(&at("-> f32", "-> vec2<f32>").replace("return ", "return vec2(1.0) * "), 4, &["signature"]);
    refused(&format!("{PCF}override wide: f32;\n"), 4, &["mine.wgsl:8:", "[constants]"]);
    refused(&format!("{PCF}fn turned(a: f32) -> f32 {{ return a; }}\n"), 4, &["mine.wgsl:8:", "turned"]);
    refused(
        &format!("{PCF}@group(0) @binding(5) var<storage, read_write> mine: array<f32>;\n"),
        4,
        &["mine.wgsl:8:", "resource"],
    );
}

#[test]
fn headers_are_refused_at_their_line() {
    let with = |line: &str| PCF.replace("//! filter_taps = 16", line);
    refused(&with("//! taps = 16"), 4, &["mine.wgsl:3:5:", "taps"]);
    refused(&with("//! filter_taps = 0"), 4, &["mine.wgsl:3:", "0 taps"]);
    refused(&with("//! lights = []"), 4, &["mine.wgsl:3:", "sun"]);
    refused(&with("//! constants.wide = \"very\""), 4, &["mine.wgsl:3:", "a constant is a number"]);
    refused(&with("//! constants.wide = 1e60"), 4, &["mine.wgsl:3:", "32 bits"]);
    refused(&with("//! constants.fn = 1"), 4, &["mine.wgsl:3:"]);
    refused(&with("//! constants.turned = 1"), 4, &["mine.wgsl:3:", "turned"]);
    refused(&PCF.replace("//! name", "// name"), 4, &["mine.wgsl:", "name"]);
    refused("fn shade(r: Receiver) -> f32 { return 1.0; }", 4, &["mine.wgsl:1:1:", "no header"]);
    refused(&format!("{PCF}//! seeds = 3\n"), 4, &["mine.wgsl:8:", "below code"]);
}

#[test]
fn an_error_does_not_quote_the_program_s_own_source() {
    let folder = folder_with(&format!("{PCF}/* "));
    let ran = evaluate(folder.path(), "--variant hard/light-matched").ended_with(4).says("mine.wgsl:8:");
    assert!(ran.stderr.len() < 1000, "{} bytes: {}", ran.stderr.len(), ran.stderr);
}

#[test]
fn names_that_are_taken_are_refused() {
    refused(&PCF.replace("\"mine\"\n//! title", "\"chss\"\n//! title"), 4, &["mine.wgsl:1:", "built-in"]);
    let folder = folder_with(PCF);
    evaluate(folder.path(), "--technique mine.wgsl").ended_with(2).says("two --technique");
}

#[test]
fn values_that_are_no_fraction_are_not_scored() {
    let returning =
        |value: &str| HARD.replace("return lit_nearest", &format!("return {value} + 0.0 * lit_nearest"));
    refused(&returning("sqrt(-1.0 - abs(r.position.x))"), 4, &["mine (mine.wgsl) returned NaN"]);
    refused(&returning("(1.5 + abs(r.position.x))"), 4, &["mine (mine.wgsl) returned"]);
}

#[test]
fn a_loop_without_end_is_refused_before_a_device_sees_it() {
    let endless = |head: &str| {
        HARD.replace("    return", &format!("    var i = 0;\n    {head} {{ i++; }}\n    return"))
    };
    refused(&endless("loop"), 4, &["mine.wgsl:11:", "nothing ends"]);
    refused(&endless("while true"), 4, &["mine.wgsl:11:", "nothing ends"]);
    // Software drivers end any other by force after 65535 rounds; what comes of it is no fraction.
    let counted = endless("while map_texels() > 1.0").replace("return lit", "return f32(i) + lit");
    refused(&counted, 4, &["mine (mine.wgsl) returned"]);
}

#[test]
fn own_techniques_are_rendered_and_listed() {
    let folder = folder_with(PCF);
    let line = "render scene.toml --size 32x18 --technique mine.wgsl --map 128 --out frames";
    let ran = run(&mut umbrage(folder.path(), line)).ended_with(0);
    assert!(ran.stdout.contains("mine-light-matched.0000.exr"), "{}", ran.stdout);
    let ran = run(&mut umbrage(folder.path(), "list variants --technique mine.wgsl")).ended_with(0);
    assert!(ran.stdout.lines().any(|l| l.starts_with("mine ")), "{}", ran.stdout);
}

/// The example that docs/your-technique.md ends with holds what the page says of it.
#[test]
fn the_example_swims_less_than_the_penumbra_mask() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let example = std::fs::read_to_string(root.join("examples/own.wgsl")).expect("the example");
    let page = std::fs::read_to_string(root.join("docs/your-technique.md")).expect("the page");
    assert!(page.trim_end().ends_with(&format!("```wgsl\n{example}```")), "the page ends with the example");
    let folder = folder_with(&example);
    let line = "evaluate colonnade --path P1 --path P4 --size 320x180 --variant chss-mask/light-matched --seeds 2 \
                --samples 128 --technique mine.wgsl --cache cache --out run";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    let card = Card::load(&folder.path().join("run"));
    for path in ["P1", "P4"] {
        let window = format!("colonnade {path}");
        let pair = ("steady/light-matched", "chss-mask/light-matched");
        let swimming = card.paired(&window, pair, "swimming");
        assert!(swimming.high < 0.0, "{path}: {swimming:?}");
        let error = card.paired(&window, pair, "error");
        assert!(error.high < 0.0, "{path}: {error:?}");
    }
}
