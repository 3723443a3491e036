//! Runs that are killed, runs side by side, caches that are damaged: nothing is lost, nothing half
//! is kept, and no score changes.

use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant, SystemTime};
use umbrage_tests::{Card, Ran, empty_folder, files_below, run, umbrage};

const WORK: &str = "evaluate colonnade --path P1 --path P4 --variant hard --variant chss --variant chss-mask \
                    --size 128x72 --frames 4 --seeds 2 --samples 64 --map 512";

fn evaluate(folder: &Path, places: &str) -> Ran {
    run(&mut umbrage(folder, &format!("{WORK} {places}"))).ended_with(0)
}

fn scores(run: PathBuf) -> String {
    std::fs::read_to_string(run.join("scores.csv")).expect("scores")
}

/// The scores of an undisturbed run with a cache of its own.
fn undisturbed() -> &'static str {
    static SCORES: OnceLock<String> = OnceLock::new();
    SCORES.get_or_init(|| {
        let folder = empty_folder();
        evaluate(folder.path(), "--out run --cache cache");
        scores(folder.path().join("run"))
    })
}

fn start(folder: &Path, places: &str) -> Child {
    let mut command = umbrage(folder, &format!("{WORK} {places}"));
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("started")
}

/// Waits until a run has come so far, then kills it as `kill -9` does.
fn kill_when(mut child: Child, so_far: impl Fn() -> bool) {
    let patience = Instant::now();
    while !so_far() {
        assert!(patience.elapsed() < Duration::from_secs(60), "the run does not get there");
        assert!(child.try_wait().expect("asked").is_none(), "the run ended before it could be killed");
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("killed");
    let status = child.wait().expect("gone");
    assert_eq!(status.code(), None, "ended by the signal, in the middle of its work");
}

/// Whole results of a cache: truths and measured variants.
fn entries(cache: &Path) -> Vec<PathBuf> {
    let whole = |path: &PathBuf| {
        let place = path.strip_prefix(cache).expect("below the cache");
        place.components().all(|part| !part.as_os_str().to_string_lossy().starts_with("tmp"))
    };
    files_below(cache).into_iter().filter(whole).collect()
}

fn modified(path: &PathBuf) -> SystemTime {
    std::fs::metadata(path).and_then(|m| m.modified()).expect("a time")
}

#[test]
fn the_same_run_twice_gives_the_same_bits() {
    let folder = empty_folder();
    evaluate(folder.path(), "--out run --cache another-cache");
    assert_eq!(scores(folder.path().join("run")), undisturbed());
}

#[test]
fn a_killed_run_takes_up_where_it_was() {
    let folder = empty_folder();
    let cache = folder.path().join("cache");
    let places = "--out run --cache cache";
    // As soon as there is a cache; when a truth is kept; when a variant is.
    let kept = |part: &str| !entries(&cache.join(part)).is_empty();
    kill_when(start(folder.path(), places), || cache.join("units").exists());
    kill_when(start(folder.path(), places), || kept("truth"));
    kill_when(start(folder.path(), places), || kept("units"));
    assert!(!folder.path().join("run/index.html").exists(), "there is no report of half a run");
    let before: Vec<_> = entries(&cache).into_iter().map(|path| (modified(&path), path)).collect();

    evaluate(folder.path(), places);
    for (time, path) in &before {
        assert_eq!(modified(path), *time, "{} was made again", path.display());
    }
    assert_eq!(scores(folder.path().join("run")), undisturbed());
    let card = Card::load(&folder.path().join("run"));
    // Every variant of P1 that was kept came after P1's truth: that was not rendered again.
    assert_eq!(card.windows()[0]["truth_secs"], serde_json::Value::Null);
    assert!(files_below(&cache.join("truth/tmp")).is_empty(), "what the dead left is swept");

    let started = Instant::now();
    evaluate(folder.path(), "--out again --cache cache");
    let card = Card::load(&folder.path().join("again"));
    for window in card.windows() {
        assert_eq!(window["truth_secs"], serde_json::Value::Null, "no truth is rendered twice");
    }
    assert_eq!(scores(folder.path().join("again")), undisturbed());
    assert!(started.elapsed() < Duration::from_secs(60));
}

/// A killed run's unfinished results are nobody's after a day; younger ones may belong to a run
/// that is alive.
#[test]
fn what_the_dead_left_is_cleared_away() {
    let folder = empty_folder();
    let units = folder.path().join("cache/units");
    for (name, days) in [("tmp-1-old", 2), ("tmp-1-young", 0)] {
        let path = units.join(name);
        std::fs::create_dir_all(&path).expect("made");
        let time = SystemTime::now() - Duration::from_secs(days * 24 * 3600);
        std::fs::File::open(&path).and_then(|f| f.set_modified(time)).expect("dated");
    }
    let line = "evaluate colonnade --path P1 --variant hard --size 16x9 --frames 2 --samples 16 --map 64 \
                --out run --cache cache";
    run(&mut umbrage(folder.path(), line)).ended_with(0);
    assert!(!units.join("tmp-1-old").exists() && units.join("tmp-1-young").exists());
}

#[test]
fn two_runs_at_once_share_a_cache() {
    let folder = empty_folder();
    let both = ["one", "two"].map(|out| start(folder.path(), &format!("--out {out} --cache cache")));
    for mut child in both {
        assert!(child.wait().expect("ended").success());
    }
    for out in ["one", "two"] {
        assert_eq!(scores(folder.path().join(out)), undisturbed(), "{out}");
    }
    let left: Vec<_> =
        files_below(folder.path()).into_iter().filter(|p| p.to_string_lossy().contains("tmp-")).collect();
    assert!(left.is_empty(), "{left:?}");
}

/// A flipped bit in a truth, a cut in one measured variant and in another's picture.
#[test]
fn a_damaged_cache_is_noticed_and_repaired() {
    let folder = empty_folder();
    let cache = folder.path().join("cache");
    evaluate(folder.path(), "--out first --cache cache");
    for truth in entries(&cache.join("truth")) {
        let mut bytes = std::fs::read(&truth).expect("read");
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        std::fs::write(&truth, bytes).expect("damaged");
    }
    let of = |name: &str| {
        let units = entries(&cache.join("units")).into_iter();
        units.filter(|path| path.ends_with(name)).collect::<Vec<_>>()
    };
    for (damaged, name) in ["numbers.json", "pictures.exr", "checksum"].into_iter().enumerate() {
        let path = &of(name)[damaged];
        let bytes = std::fs::read(path).expect("read");
        std::fs::write(path, &bytes[..bytes.len() / 2]).expect("damaged");
    }
    let ran = evaluate(folder.path(), "--out second --cache cache");
    let said = |words: &str| ran.stderr.matches(words).count();
    assert_eq!(said("a cached result was damaged"), 3, "{}", ran.stderr);
    assert!(said("a cached truth was damaged") > 0, "{}", ran.stderr);
    let card = Card::load(&folder.path().join("second"));
    for window in card.windows() {
        assert!(window["notes"].to_string().contains("damaged"), "the report says so too: {window}");
    }
    assert_eq!(scores(folder.path().join("second")), undisturbed());

    let ran = evaluate(folder.path(), "--out third --cache cache");
    assert!(!ran.stderr.contains("damaged"), "repaired once and for all: {}", ran.stderr);
    let card = Card::load(&folder.path().join("third"));
    assert!(card.windows().iter().all(|w| w["truth_secs"].is_null()), "and whole again");
}
