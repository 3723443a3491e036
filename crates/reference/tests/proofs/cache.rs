//! The cache under corruption, threads, processes and kill -9.

use crate::common::*;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use umbrage_reference::{Cache, GroundTruth, Method, Points, Source, Tracer, TruthKey, TruthSettings};

/// Set for the child processes of these tests: the folder of their cache.
const FOLDER: &str = "UMBRAGE_TEST_CACHE";

fn made_up(points: usize, seed: u64) -> GroundTruth {
    let mut random = Random(seed);
    let mut list = || (0..points).map(|_| random.unit()).collect::<Vec<f32>>();
    GroundTruth {
        mean: list(),
        halves: [list(), list()],
        basis: list(),
        variance: list(),
        samples: (0..points as u32).collect(),
        facing: list().iter().map(|&v| v > 0.5).collect(),
    }
}

fn keys() -> impl Fn(u64) -> TruthKey {
    let tracer = Tracer::new(&scene(&floor(1.0))).expect("a scene");
    let points = on_floor([0.1, 0.2], 0.0);
    move |seed| {
        let settings = TruthSettings { seed, ..settings(8, Method::Shafts) };
        tracer.truth_key(&points, &overhead_sun(1.0), &settings)
    }
}

#[test]
fn stored_and_read_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::open(folder.path()).expect("a cache");
    let key = keys()(0);
    for truth in [made_up(1000, 1), GroundTruth { basis: vec![], ..made_up(10, 2) }, GroundTruth::default()] {
        let _ = fs::remove_file(cache.path(key));
        let (first, source) = cache.truth(key, || truth.clone()).expect("a truth");
        assert!(matches!(source, Source::Computed) && first == truth);
        let (second, source) = cache.truth(key, || unreachable!("it is stored")).expect("a truth");
        assert!(matches!(source, Source::Stored) && second == truth);
    }
}

/// Whatever changes the truth changes its key.
#[test]
fn keys_follow_content() {
    let points = on_floor([0.1, 0.2], 0.0);
    let tracer = |half| Tracer::new(&scene(&floor(half))).expect("a scene");
    let key = |half, points: &Points, degrees, settings: &TruthSettings| {
        tracer(half).truth_key(points, &overhead_sun(degrees), settings)
    };
    let base = settings(8, Method::Shafts);
    let mut others = vec![
        key(1.5, &points, 1.0, &base),
        key(1.0, &points, 1.1, &base),
        key(1.0, &on_floor([0.1, 0.3], 0.0), 1.0, &base),
        key(1.0, &on_floor([0.1], 0.0), 1.0, &base),
        key(1.0, &points, 1.0, &TruthSettings { samples: 9, ..base }),
        key(1.0, &points, 1.0, &TruthSettings { replicates: 4, ..base }),
        key(1.0, &points, 1.0, &TruthSettings { basis_samples: 9, ..base }),
        key(1.0, &points, 1.0, &TruthSettings { seed: 9, ..base }),
        key(1.0, &points, 1.0, &TruthSettings { method: Method::Rays, ..base }),
        key(1.0, &points, 1.0, &TruthSettings { tolerance: Some(0.01), ..base }),
    ];
    others.push(key(1.0, &points, 1.0, &base));
    assert_eq!(others.last(), Some(&key(1.0, &points, 1.0, &base)), "the same content, the same key");
    let all: std::collections::HashSet<_> = others.iter().collect();
    assert_eq!(all.len(), others.len());
}

#[test]
fn corruption_is_found_and_repaired() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::open(folder.path()).expect("a cache");
    let (key, truth) = (keys()(0), made_up(50, 1));
    cache.truth(key, || truth.clone()).expect("a truth");
    let whole = fs::read(cache.path(key)).expect("an entry");
    let flipped = |at: usize| {
        let mut bytes = whole.clone();
        bytes[at] ^= 1;
        bytes
    };
    let mut damaged: Vec<Vec<u8>> = [0, 9, 13, 17, 40, 64, 500, whole.len() - 1].map(flipped).to_vec();
    damaged.extend([0, 10, 64, whole.len() - 1].map(|length| whole[..length].to_vec()));
    damaged.push([whole.clone(), vec![0]].concat());
    for bytes in damaged {
        fs::write(cache.path(key), &bytes).expect("written");
        let (found, source) = cache.truth(key, || truth.clone()).expect("a truth");
        assert!(matches!(source, Source::Repaired) && found == truth);
        assert_eq!(fs::read(cache.path(key)).expect("an entry"), whole, "repaired on disk");
    }
}

#[test]
fn a_disk_that_takes_nothing_loses_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::open(folder.path()).expect("a cache");
    fs::remove_dir_all(folder.path()).expect("removed");
    fs::write(folder.path(), "a file where the folder was").expect("written");
    let key = keys()(0);
    match cache.truth(key, || made_up(5, 1)) {
        Ok((truth, Source::NotStored(_))) => assert_eq!(truth, made_up(5, 1)),
        Err(error) => assert!(error.to_string().contains("cache"), "{error}"),
        Ok((_, source)) => panic!("{source:?}"),
    }
    assert!(Cache::open(folder.path()).is_err(), "a file is no folder");
    fs::remove_file(folder.path()).expect("removed");
    fs::create_dir(folder.path()).expect("for the guard to remove");
}

#[test]
fn threads_on_one_key() {
    let folder = tempfile::tempdir().expect("a folder");
    let key = keys()(0);
    std::thread::scope(|scope| {
        for _ in 0..8 {
            scope.spawn(|| {
                let cache = Cache::open(folder.path()).expect("a cache");
                for _ in 0..20 {
                    let (truth, _) = cache.truth(key, || made_up(500, 1)).expect("a truth");
                    assert_eq!(truth, made_up(500, 1));
                }
            });
        }
    });
    assert_eq!(temporaries(folder.path()), 0);
}

#[test]
fn leftovers_are_swept_but_not_from_the_living() {
    let folder = tempfile::tempdir().expect("a folder");
    drop(Cache::open(folder.path()).expect("a cache"));
    let temporary = folder.path().join("tmp");
    fs::write(temporary.join("1-0"), "half a f").expect("written");
    let living = fs::File::create_new(temporary.join("2-0")).expect("created");
    living.lock().expect("locked");
    drop(Cache::open(folder.path()).expect("a cache"));
    assert!(!temporary.join("1-0").exists() && temporary.join("2-0").exists());
    drop(living);
    drop(Cache::open(folder.path()).expect("a cache"));
    assert_eq!(temporaries(folder.path()), 0);
}

/// Two processes write the same twenty keys; then two are killed in the middle of large entries.
#[test]
fn processes_at_once_and_kill_9() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut children = [writer(folder.path()), writer(folder.path())];
    std::thread::sleep(std::time::Duration::from_millis(700));
    for child in &mut children {
        child.kill().expect("SIGKILL");
        child.wait().expect("gone");
    }
    let cache = Cache::open(folder.path()).expect("a cache");
    assert_eq!(temporaries(folder.path()), 0, "the dead hold no locks");
    let mut stored = 0;
    for seed in 0..WRITTEN {
        let (truth, source) = cache.truth(keys()(seed), || made_up(LARGE, seed)).expect("a truth");
        assert!(!matches!(source, Source::Repaired), "half an entry under its name");
        stored += usize::from(matches!(source, Source::Stored));
        assert!(truth == made_up(LARGE, seed));
    }
    assert!(stored > 0, "the children wrote nothing");
}

const WRITTEN: u64 = 6;
const LARGE: usize = 100_000;

fn writer(folder: &Path) -> Child {
    Command::new(std::env::current_exe().expect("this program"))
        .args(["--exact", "cache::child_process"])
        .env(FOLDER, folder)
        .stdout(Stdio::null())
        .spawn()
        .expect("a child")
}

/// Not a test of its own: in a child of the test above, writes until it is killed.
#[test]
fn child_process() {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let cache = Cache::open(&folder).expect("a cache");
    let key = keys();
    for seed in (0..WRITTEN).cycle() {
        let (truth, _) = cache.truth(key(seed), || made_up(LARGE, seed)).expect("a truth");
        assert!(truth == made_up(LARGE, seed));
        // Now and then an entry goes, so that there is always one to write.
        let _ = fs::remove_file(cache.path(key((seed + 3) % WRITTEN)));
    }
}

fn temporaries(folder: &Path) -> usize {
    fs::read_dir(folder.join("tmp")).expect("a folder").count()
}
