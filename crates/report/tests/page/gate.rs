//! The gate's part of the page: what would fail at other margins.

use super::{SIZE, viewer};
use crate::fixture::{self, Device};
use umbrage_metrics::{Score, Verdict};
use umbrage_report::{ChangeCard, GateCard, GateCase, Layout, Side, write_report};

/// A case with a margin of 1.
fn case(variant: &str, verdict: Verdict, would_pass_at: f64) -> GateCase {
    let harm = Score { value: would_pass_at + 0.2, low: would_pass_at, high: would_pass_at + 0.4 };
    GateCase {
        scene: None,
        path: None,
        first_frame: None,
        variant: variant.into(),
        metric: "error".into(),
        worst_frame: None,
        worst_place: None,
        change: Some(ChangeCard {
            base: 1.0,
            now: 1.0 + harm.value,
            harm,
            margin: 1.0,
            verdict,
            caught: 1.0,
            would_pass_at,
            needs_times: None,
        }),
        reproduce: None,
        crop: None,
        crop_shows: Vec::new(),
    }
}

/// At the gate's own margins the explorer says what the gate said, also of a case that passes by the correction
/// alone; wider ones fail fewer, narrower ones more.
#[test]
#[ignore = "needs a browser: cargo xtask page"]
fn thresholds_start_from_what_the_gate_said() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fixture::write(folder.path(), Device::Software, SIZE).expect("stored");
    let side = || Side { tool_version: "1".into(), date: "today".into(), command: "umbrage evaluate".into() };
    let card = GateCard {
        base: side(),
        run: side(),
        baseline: "main".into(),
        accept: "umbrage accept run --name main".into(),
        new: Vec::new(),
        margins_changed: Vec::new(),
        cases: vec![
            case("far", Verdict::Regressed, 9.0),
            case("near", Verdict::Regressed, 1.5),
            case("corrected", Verdict::Inconclusive, 1.1),
            case("sound", Verdict::Unchanged, 0.3),
        ],
    };
    card.save(folder.path()).expect("stored");
    let written = write_report(folder.path(), Layout::SingleFile).expect("reported");
    let mut browser = viewer(&written.index);
    // Exponents of 2: as they are, twice, four times, half, a quarter as wide.
    for (exponent, fails) in [("0", 2), ("1", 1), ("2", 1), ("4", 0), ("-1", 3), ("-2", 4)] {
        browser.eval(&format!(
            "document.querySelector('.thresholds input').value = '{exponent}', \
             document.querySelector('.thresholds input').dispatchEvent(new Event('input'))"
        ));
        let says = browser.eval("document.querySelector('.thresholds .says').textContent");
        let wanted = format!(", {fails} of 4 would fail.");
        assert!(says.as_str().is_some_and(|s| s.ends_with(&wanted)), "2^{exponent}: {says}");
    }
    assert_eq!(browser.complaints(), Vec::<String>::new());
}
