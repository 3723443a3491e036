//! Files that are missing, broken or twice, and frames without cameras.

use super::{COUNT, Handed, WAYS, noisy};
use umbrage_frame::{Image, Layer, write_exr};
use umbrage_tests::{Card, run, umbrage};

#[test]
fn frames_without_cameras_are_scored_one_by_one() {
    let handed = Handed::new();
    handed.rewrite("mine", |n, image| noisy(image, n as u32 + 3));
    let line = "score --frames mine.####.exr --reference-frames shadow.####.exr --out run";
    let ran = run(&mut umbrage(handed.folder(), line)).ended_with(0);
    assert!(ran.stderr.contains("per-frame scores only"), "{}", ran.stderr);
    let card = Card::load(&handed.folder().join("run"));
    assert_eq!(card.windows().len(), COUNT);
    for (_, _, scores) in card.results() {
        let error = scores["error"]["value"].as_f64().expect("ERROR");
        // +-.1 uniform: .058; clamping takes some off.
        assert!((0.04..0.06).contains(&error), "{error}");
        assert!(scores["swimming"]["not_measured"].is_string(), "{}", scores["swimming"]);
    }
}

#[test]
fn nothing_without_cameras_passes_in_silence() {
    let handed = Handed::new();
    handed.rewrite("mine", |n, image| noisy(image, 3 + u32::from(n > 1)));
    std::fs::copy(handed.folder().join("mine.0000.exr"), handed.folder().join("mine.0001.exr"))
        .expect("copied");
    for hole in ["shadow.0002.exr", "mine.0002.exr"] {
        std::fs::remove_file(handed.folder().join(hole)).expect("removed");
    }
    let line = "score --frames mine.####.exr --reference-frames shadow.####.exr --out run";
    let ran = run(&mut umbrage(handed.folder(), line)).ended_with(0);
    ran.says("shadow.####.exr: frames 2 are missing").says("mine.####.exr: frames 1 repeat the one before");
    std::fs::remove_file(handed.folder().join("mine.0003.exr")).expect("removed");
    run(&mut umbrage(handed.folder(), line)).ended_with(4).says("1 of 4 frames are missing: 3");
}

#[test]
fn bad_frames_are_named() {
    let handed = Handed::new();
    let folder = handed.folder();
    let shadow = |number: usize| folder.join(format!("shadow.{number:04}.exr"));
    let original: Vec<Vec<u8>> = (0..COUNT).map(|n| std::fs::read(shadow(n)).expect("read")).collect();
    let broken = |number: usize, bytes: &[u8], code: i32, words: &[&str]| {
        std::fs::write(shadow(number), bytes).expect("written");
        let mut ran = handed.score(&format!("--cameras cameras.json {}", WAYS[1])).ended_with(code);
        for word in words {
            ran = ran.says(word);
        }
        std::fs::write(shadow(number), &original[number]).expect("written");
    };
    let written = |layers: &[Layer]| {
        let file = folder.join("made.exr");
        write_exr(&file, layers).expect("written");
        std::fs::read(&file).expect("read")
    };
    let plane = |width, height, value: f32| ("shadow.V".to_string(), Image::filled(width, height, value));
    broken(3, &original[3][..original[3].len() / 2], 4, &["shadow.0003.exr"]);
    broken(2, &written(&[plane(80, 45, 0.5)]), 4, &["shadow.0002.exr: has 80x45 pixels", "160x90"]);
    let mut holes = Image::filled(160, 90, 0.5);
    holes.pixels_mut()[161] = f32::NAN;
    holes.pixels_mut()[500] = f32::INFINITY;
    broken(
        2,
        &written(&[("shadow.V".into(), holes)]),
        4,
        &["2 pixels are NaN or infinite, the first at (1, 1)"],
    );
    let odd = [
        ("left.A".to_string(), Image::filled(160, 90, 0.5)),
        ("right.A".into(), Image::filled(160, 90, 0.5)),
    ];
    broken(0, &written(&odd), 4, &["left.A, right.A", "--channel"]);
    broken(2, &original[1], 4, &["frames 1 and 2 are the same picture", "px between them"]);
    // A header that promises a gigapixel is refused before memory is asked for.
    let mut huge = original[0].clone();
    let at = huge.windows(10).position(|w| w == b"dataWindow").expect("a header")
        + b"dataWindow\0box2i\0".len()
        + 4;
    huge[at + 8..at + 16].copy_from_slice(&[0xff, 0xff, 0, 0, 0xff, 0xff, 0, 0]);
    broken(0, &huge, 4, &["shadow.0000.exr"]);
    for number in [1, 3] {
        std::fs::remove_file(shadow(number)).expect("removed");
    }
    let ran = handed.score(&format!("--cameras cameras.json {}", WAYS[1])).ended_with(4);
    assert!(ran.stderr.contains("2 of 5 frames are missing: 1, 3"), "{}", ran.stderr);
    handed.score("--cameras cameras.json --frames nothing.####.exr").ended_with(4).says("no file fits");
    handed.score("--cameras nothing.json --frames shadow.####.exr").ended_with(4).says("nothing.json");
}
