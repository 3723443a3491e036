//! `scorecard.json`: what goes in comes out, and what must not go in does not.

#[expect(dead_code, reason = "other tests write the pictures too")]
mod fixture;

use fixture::{Device, scorecard};
use umbrage_metrics::{Measurement, Missing, Score};
use umbrage_report::{Measured, Scorecard, scorecard_schema};

#[test]
fn the_shipped_schema_is_current() {
    // To renew it: UMBRAGE_BLESS=1 cargo test -p umbrage-report --test scorecard
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/scorecard.schema.json");
    if std::env::var_os("UMBRAGE_BLESS").is_some() {
        std::fs::write(path, scorecard_schema()).expect("written");
    }
    let shipped = std::fs::read_to_string(path).expect("crates/report/scorecard.schema.json");
    assert!(shipped == scorecard_schema(), "the schema has changed: bless it, and raise SCHEMA_VERSION");
}

#[test]
fn a_scorecard_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scorecard.json");
    let card = scorecard(Device::Gpu, (480, 270));
    card.save(&path).expect("saved");
    assert_eq!(Scorecard::load(&path).expect("loaded"), card);
}

#[test]
fn a_file_from_before_the_picture_was_counted_still_loads() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scorecard.json");
    let text = scorecard(Device::Gpu, (480, 270)).to_json().expect("legal");
    let new = |line: &&str| line.contains("\"picture\":") || line.contains("\"occluded\":");
    let older: Vec<&str> = text.lines().filter(|line| !new(line)).collect();
    std::fs::write(&path, older.join("\n")).expect("written");
    let card = Scorecard::load(&path).expect("loaded");
    assert!(card.windows.iter().all(|w| w.picture == 0.0 && w.occluded == 0.0));
}

#[test]
fn another_version_is_refused_with_the_reason() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scorecard.json");
    let refusal = |text: &str| {
        std::fs::write(&path, text).expect("written");
        Scorecard::load(&path).expect_err("refused").to_string()
    };
    let newer = refusal("{\"schema_version\": 99, \"anything\": []}");
    assert!(newer.contains("schema_version 99") && newer.contains("run the evaluation again"), "{newer}");
    assert!(refusal("{}").contains("not a scorecard"));
    assert!(refusal("{\"schema_version\": 1").contains("not JSON"));
    assert!(refusal("{\"schema_version\": 1}").contains("missing field"));
}

#[test]
fn nan_is_never_written() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("scorecard.json");
    let mut card = scorecard(Device::Gpu, (480, 270));
    card.results[0].scores.insert("noise".into(), Score { value: 0.1, low: f64::NAN, high: 0.2 }.into());
    let message = card.save(&path).expect_err("refused").to_string();
    for part in ["d8-colonnade", "P1 dolly", "hard (light-matched)", "noise"] {
        assert!(message.contains(part), "{message}");
    }
    assert!(!path.exists());
    let mut card = scorecard(Device::Gpu, (480, 270));
    card.windows[1].coverage = f64::INFINITY;
    assert!(card.check().expect_err("refused").to_string().contains("coverage"));
    let mut card = scorecard(Device::Gpu, (480, 270));
    card.windows[0].picture = f64::NAN;
    assert!(card.check().expect_err("refused").to_string().contains("picture"));
    let mut card = scorecard(Device::Gpu, (480, 270));
    card.windows[0].occluded = f64::NAN;
    assert!(card.check().expect_err("refused").to_string().contains("occluded"));
}

#[test]
fn a_card_that_points_nowhere_is_refused() {
    let mut card = scorecard(Device::Gpu, (480, 270));
    card.results[0].window = 17;
    assert!(card.check().expect_err("refused").to_string().contains("no window 17"));
    let mut card = scorecard(Device::Gpu, (480, 270));
    card.overall[1].variant = card.overall[0].variant;
    assert!(card.check().expect_err("refused").to_string().contains("two results"));
}

#[test]
fn a_missing_measurement_keeps_its_reason_once() {
    let measured = Measured::from(Measurement::NotMeasured(Missing::OneFrame));
    assert_eq!(measured, Measured::no("one frame only"));
}
