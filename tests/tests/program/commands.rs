//! Commands, lists, and mistakes on the command line.

use serde_json::Value;
use umbrage_tests::{Ran, empty_folder, run, umbrage};

fn said(line: &str) -> Ran {
    run(&mut umbrage(empty_folder().path(), line))
}

fn listed(what: &str) -> Vec<Value> {
    let ran = said(&format!("list {what} --json")).ended_with(0);
    serde_json::from_str::<Value>(&ran.stdout).expect("JSON").as_array().expect("a list").clone()
}

#[test]
fn help_states_the_exit_codes() {
    let help = said("--help").ended_with(0).stdout;
    for promise in ["0 pass", "1 regression", "2 usage", "3", "4 input", "5 no baseline"] {
        assert!(help.contains(promise), "no \"{promise}\" in:\n{help}");
    }
}

#[test]
fn every_list_is_the_same_as_text_and_as_json() {
    for what in ["scenes", "paths", "variants", "metrics", "adapters"] {
        let rows = listed(what);
        assert!(!rows.is_empty(), "no {what}: without an adapter install mesa-vulkan-drivers");
        let text = said(&format!("list {what}")).ended_with(0).stdout;
        assert_eq!(text.lines().count(), rows.len() + 1, "a heading and a line each:\n{text}");
        // The heading names the fields; each line holds every value of its row.
        let heading = text.lines().next().expect("a heading");
        for (row, line) in rows.iter().zip(text.lines().skip(1)) {
            for (key, value) in row.as_object().expect("an object") {
                assert!(heading.contains(key.as_str()), "{key} in {heading}");
                assert!(line.contains(value.as_str().expect("text")), "{value} in {line}");
            }
        }
    }
}

#[test]
fn lists_hold_the_standard_suite() {
    let names = |what: &str, key: &str| -> Vec<String> {
        listed(what).iter().map(|row| row[key].as_str().expect("text").to_string()).collect()
    };
    let scenes = names("scenes", "scene");
    let suite = ["edge-ladder", "thin-poles", "stacked-blockers", "oblique-floor", "colonnade"];
    let more = ["contact", "grating", "foliage", "curved-receivers", "point-light-room"];
    for scene in suite.into_iter().chain(more) {
        assert!(scenes.iter().any(|s| s == scene), "{scene}");
    }
    let variants = names("variants", "variant");
    let wanted = ["hard", "pcf-grid-11", "pcf-vogel-16", "pcf-vogel-16-ign", "chss", "chss-mask", "chss-min"];
    for variant in wanted {
        assert!(variants.iter().any(|v| v == variant), "{variant}");
    }
    let metrics = names("metrics", "metric");
    for metric in ["error", "banding", "swimming", "noise", "light_leak", "false_shadow"] {
        assert!(metrics.iter().any(|m| m == metric), "{metric}");
    }
}

#[test]
fn usage_mistakes_exit_2_before_any_work() {
    let cases = [
        ("", "Usage"),
        ("evalute", "evaluate"),
        ("evaluate --no-such-flag", "--no-such-flag"),
        ("list nothing", "nothing"),
        ("render colonnade", "--variant"),
        ("evaluate colonnade --variant pcss-cube", "pcss-listing"),
        ("evaluate colonnade --variant pcf-cube/as-printed", "lights that have a place"),
        ("evaluate point-light-room --variant chss-distance", "chss-linear"),
        ("evaluate colonnade --size 640", "WIDTHxHEIGHT"),
        ("evaluate colonnade --size 0x0", "at least one pixel"),
        ("evaluate colonnade --size 64x0", "at least one pixel"),
        ("evaluate colonnade --size -4x4", "-4"),
        ("evaluate colonnade --size 99999999999x4", "99999999999"),
        ("evaluate colonnade --frames 0", "--frames"),
        ("evaluate colonnade --seeds 1", "--seeds"),
        ("evaluate colonnade --samples 3", "--samples"),
    ];
    for (line, words) in cases {
        said(line).ended_with(2).says(words);
    }
}

/// A technique that keeps frames has no score in one: refused by name, with the reason and the cure.
#[test]
fn one_frame_is_refused_to_a_variant_with_a_history() {
    for name in ["temporal-checker", "temporal-mask"] {
        let line = format!("evaluate colonnade --frames 1 --variant hard --variant {name}");
        let refused = said(&line).ended_with(2).says(name).says("frames before it").says("no temporal score");
        refused.says("--frames 2");
    }
}

#[test]
fn unknown_names_suggest_the_nearest() {
    let cases = [
        ("evaluate colonade", "did you mean 'colonnade'?"),
        ("reference colonade", "did you mean 'colonnade'?"),
        ("evaluate colonnade --path P11", "did you mean 'P1'?"),
        ("reference colonnade --path P11", "did you mean 'P1'?"),
        ("evaluate colonnade --variant chs-mask", "did you mean \"chss-mask\"?"),
        ("evaluate colonnade --variant chss/as-print", "did you mean \"chss/as-printed\"?"),
        ("render colonnade --variant hrad", "did you mean \"hard\"?"),
        ("evaluate --scene colonade", "colonnade"),
        ("reference colonnade --frame 9999", "there is no frame 9999"),
        ("reference colonnade --reference-on gpu --method rays", "a GPU does --method scanlines only"),
        ("reference colonnade --reference-on gpu --backend vulcan", "choose vulkan, metal or dx12"),
    ];
    for (line, words) in cases {
        said(line).ended_with(2).says(words);
    }
}

/// A picture of 100000 x 100000 would take 40 GB for its depth alone: refused unallocated. The
/// limit on memory turns an attempt into a failure.
#[cfg(target_os = "linux")]
#[test]
fn a_picture_beyond_every_adapter_is_refused_before_it_is_allocated() {
    let folder = empty_folder();
    for command in ["evaluate colonnade", "reference colonnade", "render colonnade --variant hard"] {
        let program = umbrage_tests::program();
        let line = format!("ulimit -v 4000000; exec {} {command} --size 100000x100000", program.display());
        let mut shell = std::process::Command::new("sh");
        run(shell.args(["-c", &line]).current_dir(folder.path())).ended_with(2).says("16384 pixels a side");
    }
}

#[test]
fn a_reader_that_stops_early_is_no_failure() {
    use std::process::Stdio;
    let mut child = umbrage(empty_folder().path(), "list metrics --json")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("started");
    // Closes the pipe before anything is read.
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("ended");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.is_empty(), "{:?}: {said}", output.status);
}
