//! The gate from the outside: verdicts, exit codes, files, and what is refused.

use std::path::Path;
use umbrage_tests::{Ran, folder_with_scene, run, umbrage};

/// Small, with seeds enough to know their spread.
const SMALL: &str = "evaluate scene.toml --size 96x54 --frames 2 --seeds 3 --samples 32 --map 512 --cache cache \
                     --variant pcf-vogel-16-ign/light-matched --variant hard";

fn evaluate(folder: &Path, more: &str) -> Ran {
    run(&mut umbrage(folder, &format!("{SMALL} {more}")))
}

fn read(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join(file)).unwrap_or_else(|e| panic!("{file}: {e}"))
}

/// The one baseline file there is.
fn baseline(folder: &Path) -> std::path::PathBuf {
    let mut all = std::fs::read_dir(folder.join("reports/baselines")).expect("a folder").flatten();
    let found = all.next().expect("a baseline").path();
    assert!(all.next().is_none(), "one baseline");
    found
}

/// One story, for each run takes seconds: nothing, a baseline, the same again, worse, accepted.
#[test]
fn a_regression_is_caught_shown_and_accepted() {
    let home = folder_with_scene();
    // A scene is named after its folder, and seeds after the scene: under a random name the gate would now and then
    // raise a false alarm at other patterns (2 of 30 on two frames of so small a picture).
    let folder = &home.path().join("boxes");
    std::fs::create_dir(folder).expect("a folder");
    for file in ["model.obj", "scene.toml"] {
        std::fs::rename(home.path().join(file), folder.join(file)).expect("moved");
    }
    let none = evaluate(folder, "--out none --baseline main").ended_with(5);
    assert!(none.stderr.contains("no baseline \"main\"") && none.stderr.contains("--save-baseline main"));
    assert!(!folder.join("reports/baselines").exists() && !folder.join("none").exists(), "nothing is made");

    evaluate(folder, "--out good --save-baseline main").ended_with(0);
    let size = std::fs::metadata(baseline(folder)).expect("a file").len();
    assert!(size < 50_000, "{size} bytes are too many to commit");
    let text = std::fs::read_to_string(baseline(folder)).expect("text");
    assert!(!text.contains("--out") && !text.contains("--cache"), "folders of one machine: {text}");

    let same = evaluate(folder, "--out same --baseline main").ended_with(0);
    assert!(same.stderr.contains("gate against main: 0 regressed, 0 improved"), "{}", same.stderr);
    assert!(read(folder, "same/junit.xml").contains("failures=\"0\""));
    assert!(read(folder, "same/index.html").contains("Nothing regressed against main"));

    // Other patterns of the same build are no regression either.
    evaluate(folder, "--out fresh --baseline main --first-seed 5").ended_with(0);

    let worse = evaluate(folder, "--out worse --baseline main --bias 0.05,8,off").ended_with(1);
    the_failure_is_written_down(folder, &worse);
    evaluate(folder, "--out worse --baseline main --bias 0.05,8,off --fail-on never").ended_with(0);

    // From the stored run, without rendering; then it is the baseline.
    let again = run(&mut umbrage(folder, "compare main worse --json")).ended_with(1);
    let card: serde_json::Value = serde_json::from_str(&again.stdout).expect("one JSON value");
    assert_eq!(card["baseline"], "main");
    run(&mut umbrage(folder, "compare good worse")).ended_with(1);
    run(&mut umbrage(folder, "accept worse --name main")).ended_with(0);
    run(&mut umbrage(folder, "compare main worse")).ended_with(0);
    let back = run(&mut umbrage(folder, "compare main good"));
    assert!(back.stderr.contains(" improved"), "{}", back.stderr);
}

/// A gate that is shut lets nothing become the baseline, and a folder that is used again keeps no verdict.
#[test]
fn what_failed_is_not_saved_and_what_was_judged_is_forgotten() {
    let home = folder_with_scene();
    let folder = home.path();
    evaluate(folder, "--out run --save-baseline main").ended_with(0);
    let before = std::fs::read(baseline(folder)).expect("a file");
    evaluate(folder, "--out run --baseline main --save-baseline main --bias 0.05,8,off").ended_with(1);
    assert_eq!(std::fs::read(baseline(folder)).expect("a file"), before, "it was overwritten");
    assert!(folder.join("run/gate.json").exists() && folder.join("run/gate").exists());
    evaluate(folder, "--out run").ended_with(0);
    assert!(!folder.join("run/gate.json").exists() && !folder.join("run/gate").exists());
    // Names that no file can have are refused before anything is rendered.
    let ran = evaluate(folder, "--out never --save-baseline a/b").ended_with(2);
    assert!(!folder.join("never").exists(), "{}", ran.stderr);
    // A folder that is called like the baseline does not hide it, and one that holds no run is none.
    std::fs::create_dir(folder.join("main")).expect("made");
    run(&mut umbrage(folder, "compare main run")).ended_with(0);
    std::fs::create_dir(folder.join("empty")).expect("made");
    run(&mut umbrage(folder, "compare empty run")).ended_with(5);
}

fn the_failure_is_written_down(folder: &Path, worse: &Ran) {
    let junit = read(folder, "worse/junit.xml");
    assert!(junit.contains("<failure message=") && !junit.contains("failures=\"0\""), "{junit}");
    // One case for each of 8 scores of each of 3 variants in the one window.
    assert_eq!(junit.matches("<testcase").count(), 24, "{junit}");
    let summary = read(folder, "worse/summary.md");
    for text in [&worse.stderr, &junit, &summary] {
        for part in ["would pass at", "measure just this", "accept it", "worst at pixels"] {
            assert!(text.contains(part), "no \"{part}\" in {text}");
        }
    }
    assert!(read(folder, "worse/index.html").contains("regressed against main"));
    assert!(folder.join("worse/gate/00.png").exists(), "a picture of the worst place");
    let crop = image::open(folder.join("worse/gate/00.png")).expect("a picture").into_rgb8();
    assert!(crop.pixels().any(|p| p != crop.get_pixel(0, 0)), "and it shows something");
    // A committed baseline holds no pictures, and the page says what would.
    assert!(read(folder, "worse/index.html").contains("No picture of before"));
    the_command_measures_just_that(folder, &junit);
}

/// The printed command runs, and ends as the whole did.
fn the_command_measures_just_that(folder: &Path, junit: &str) {
    let line = junit.split("measure just this: umbrage ").nth(1).expect("a command");
    let line = line.split("&#10;").next().expect("a line");
    assert!(line.contains("--bias 0.05,8,off"), "{line}");
    let ran = run(&mut umbrage(folder, &format!("{line} --out just-this"))).ended_with(0);
    assert!(ran.stderr.contains("report: just-this"), "{}", ran.stderr);
}

#[test]
fn github_gets_annotations() {
    let home = folder_with_scene();
    let folder = home.path();
    evaluate(folder, "--out good --save-baseline main").ended_with(0);
    evaluate(folder, "--out worse --bias 0.05,8,off").ended_with(0);
    let mut compare = umbrage(folder, "compare main worse");
    let ran = run(compare.env("GITHUB_ACTIONS", "true")).ended_with(1);
    let lines: Vec<&str> = ran.stdout.lines().collect();
    assert!(!lines.is_empty() && lines.len() <= 10 && lines.iter().all(|l| l.starts_with("::error title=")));
    assert!(!lines[0]["::error title=".len()..].split("::").next().expect("a title").contains(','));
    before_after_and_truth(folder);
}

/// Against the folder of a run the picture has three parts, of which the first and the second differ.
fn before_after_and_truth(folder: &Path) {
    let two = image::open(folder.join("worse/gate/00.png")).expect("a picture").into_luma8();
    run(&mut umbrage(folder, "compare good worse")).ended_with(1);
    let three = image::open(folder.join("worse/gate/00.png")).expect("a picture").into_luma8();
    // Panels w wide with 6 px between them: 2 w + 6 and 3 w + 12.
    let width = (two.width() - 6) / 2;
    assert_eq!(three.width(), 3 * width + 12);
    let part =
        |n: u32| image::imageops::crop_imm(&three, n * (width + 6), 0, width, three.height()).to_image();
    assert!(part(0) != part(1) && part(1) != part(2), "before, after and truth differ");
    let page = read(folder, "worse/index.html");
    assert!(page.contains("left to right: before, after (") && !page.contains("No picture of before"));
}

#[test]
fn what_does_not_compare_says_why() {
    let home = folder_with_scene();
    let folder = home.path();
    evaluate(folder, "--out good --save-baseline main").ended_with(0);
    let other = SMALL.replace("96x54", "80x45").replace("--seeds 3", "--seeds 4");
    let ran = run(&mut umbrage(folder, &format!("{other} --out other --baseline main"))).ended_with(3);
    for reason in ["picture: 96x54 in the baseline, 80x45 in the run", "seeds: 3 in the baseline, 4"] {
        assert!(ran.stderr.contains(reason), "{}", ran.stderr);
    }
    let fewer = SMALL.replace("--variant hard", "");
    let ran = run(&mut umbrage(folder, &format!("{fewer} --out fewer --baseline main"))).ended_with(3);
    assert!(
        ran.stderr.contains("hard/light-matched is in the baseline and not in the run"),
        "{}",
        ran.stderr
    );
    // More than the baseline knows is no failure, and is said.
    let more = format!("{SMALL} --variant pcf-grid-3 --out more --baseline main");
    let ran = run(&mut umbrage(folder, &more)).ended_with(0);
    assert!(ran.stderr.contains("not in the baseline: pcf-grid-3"), "{}", ran.stderr);
    run(&mut umbrage(folder, "compare main more --fail-on warn")).ended_with(1);
    let finer = format!("{SMALL} --tolerance 0.01 --out finer --baseline main");
    let ran = run(&mut umbrage(folder, &finer)).ended_with(3);
    let ran = ran.says("tolerance of truth: none in the baseline, 0.01 in the run").says("--save-baseline");
    assert!(!ran.stderr.contains("picture:"), "{}", ran.stderr);
    // Two seeds cannot tell their spread.
    let two = SMALL.replace("--seeds 3", "--seeds 2");
    run(&mut umbrage(folder, &format!("{two} --out two --save-baseline two")))
        .ended_with(0)
        .says("--seeds 3");
    let ran = run(&mut umbrage(folder, "compare two two")).ended_with(3);
    assert!(ran.stderr.contains("--seeds 3"), "{}", ran.stderr);
}

#[test]
fn files_that_were_touched_are_refused() {
    let home = folder_with_scene();
    let folder = home.path();
    evaluate(folder, "--out good --save-baseline main").ended_with(0);
    let path = baseline(folder);
    let text = std::fs::read_to_string(&path).expect("text");
    let refused = |changed: String, why: &str| {
        std::fs::write(&path, changed).expect("written");
        let ran = run(&mut umbrage(folder, "compare main good")).ended_with(4);
        assert!(ran.stderr.contains(why) && ran.stderr.contains("baselines"), "{}", ran.stderr);
    };
    refused(text.replace("\"frames\": 2", "\"frames\": 3"), "its checksum does not fit");
    refused(text.replace("\"baseline_version\": 1", "\"baseline_version\": 9"), "reads version 1");
    refused(text[..text.len() / 2].into(), "not JSON");
    refused("{}".into(), "not a baseline");
    // White space is nobody's fault.
    std::fs::write(&path, text.replace("    ", "  ")).expect("written");
    run(&mut umbrage(folder, "compare main good")).ended_with(0);
    let ran = run(&mut umbrage(folder, "accept good --name ../elsewhere")).ended_with(2);
    assert!(ran.stderr.contains("no name of a baseline"), "{}", ran.stderr);
    // What a run was compared with last is what it becomes; with nothing, nobody knows.
    std::fs::remove_file(folder.join("good/gate.json")).expect("there was a gate");
    let ran = run(&mut umbrage(folder, "accept good")).ended_with(2);
    assert!(ran.stderr.contains("--name"), "{}", ran.stderr);
}

#[test]
fn margins_come_from_the_suite() {
    let home = folder_with_scene();
    let folder = home.path();
    let suite = |gate: &str, scene: &str| {
        let text = format!(
            "name = \"mine\"\nvariants = [\"hard\"]\n{gate}\n[[scene]]\nname = \"scene.toml\"\n{scene}"
        );
        std::fs::write(folder.join("suite.toml"), text).expect("written");
    };
    let line = "evaluate suite.toml --size 96x54 --frames 1 --seeds 3 --samples 32 --map 512 --cache cache";
    let gated = |name: &str| format!("{line} --bias 0.05,8,off --baseline main --out {name}");
    suite("", "");
    run(&mut umbrage(folder, &format!("{line} --save-baseline main --out good"))).ended_with(0);
    run(&mut umbrage(folder, &gated("narrow"))).ended_with(1);
    let names =
        ["error", "banding", "swimming", "noise", "noise_4x4", "light_leak", "false_shadow", "width_ratio"];
    let wide: String = names.iter().map(|n| format!("{n} = {{ absolute = 100.0 }}\n")).collect();
    suite(&format!("[gate]\n{wide}"), "");
    let ran = run(&mut umbrage(folder, &gated("wide"))).ended_with(0);
    let ran = ran.says("margin changed: error: 0.000200 or 1.00 % in the baseline, 100 or 0 % now");
    assert!(!ran.stderr.contains("margin changed: error in"), "once, not for each scene: {}", ran.stderr);
    // For one scene alone, by the name that the scene has in results.
    let inline: Vec<String> = names.iter().map(|n| format!("{n} = {{ absolute = 100.0 }}")).collect();
    suite("", &format!("gate = {{ {} }}", inline.join(", ")));
    run(&mut umbrage(folder, &gated("scene"))).ended_with(0).says("margin changed: error in ");
    suite("[gate]\neror = { absolute = 1.0 }", "");
    let ran = run(&mut umbrage(folder, &gated("wrong"))).ended_with(2);
    assert!(ran.stderr.contains("no score \"eror\" is gated"), "{}", ran.stderr);
    suite("[gate]\nerror = { absolute = -1.0 }", "");
    run(&mut umbrage(folder, &gated("negative"))).ended_with(2);
}
