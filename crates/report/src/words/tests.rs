//! Sentences obey intervals: each test moves one interval and reads what is said.

use super::{Comparison, answer};
use crate::fixture::{Device, scorecard};
use crate::{Measured, OverallCard, PairedCard, Scorecard};
use umbrage_metrics::Score;

fn score(value: f64, half: f64) -> Score {
    Score { value, low: value - half, high: value + half }
}

/// Three variants (hard, pcf-grid-11, pcf-vogel-16) with these errors and swimmings.
fn card(errors: [Score; 3], swimming: [Score; 3]) -> Scorecard {
    let mut card = scorecard(Device::Software, (48, 27));
    card.variants.truncate(3);
    card.results.clear();
    card.paired.clear();
    let overall = |variant: usize| OverallCard {
        variant,
        scores: [("error", errors[variant]), ("swimming", swimming[variant])]
            .map(|(id, s)| (id.to_string(), Measured::from(s)))
            .into(),
        cost_note: Some("not a cost: software adapter".into()),
        ..OverallCard::default()
    };
    card.overall = (0..3).map(overall).collect();
    card
}

fn say(card: &Scorecard) -> String {
    answer(card).iter().map(|s| s.plain()).collect::<Vec<_>>().join("\n")
}

const STILL: Score = Score { value: 0.0, low: 0.0, high: 0.0 };

#[test]
fn a_winner_is_named_only_when_it_is_one() {
    let apart = [score(0.03, 0.001), score(0.04, 0.001), score(0.05, 0.001)];
    assert!(
        say(&card(apart, [STILL; 3])).starts_with("hard (light-matched) is the most faithful: ERROR 0.0300")
    );
    let close = [score(0.03, 0.006), score(0.04, 0.006), score(0.05, 0.001)];
    let said = say(&card(close, [STILL; 3]));
    assert!(!said.contains("most faithful"), "{said}");
    assert!(said.contains("cannot be told apart from pcf-grid-11 (light-matched)."), "{said}");
    let same = [score(0.03, 0.02), score(0.04, 0.02), score(0.035, 0.02)];
    assert!(say(&card(same, [STILL; 3])).starts_with("No difference in ERROR could be resolved"));
}

#[test]
fn a_paired_difference_outweighs_the_intervals() {
    let close = [score(0.03, 0.006), score(0.04, 0.006), score(0.05, 0.001)];
    let mut card = card(close, [STILL; 3]);
    let difference = score(0.01, 0.002);
    let pair = PairedCard { a: 1, b: 0, window: None, metric: "error".into(), difference, resolved: true };
    card.paired.push(pair);
    assert!(say(&card).contains("hard (light-matched) is the most faithful"));
    card.paired[0].resolved = false;
    assert!(!say(&card).contains("most faithful"), "not after the correction for many comparisons");
    let all = Comparison { card: &card, window: Some(0) };
    assert!(!all.lower(0, 1, "error"), "a pooled difference says nothing about one window");
}

#[test]
fn swimming_is_none_unresolved_or_most() {
    let errors = [score(0.03, 0.001), score(0.04, 0.001), score(0.05, 0.001)];
    let said = say(&card(errors, [STILL, score(1e-6, 2e-6), score(9e-6, 1e-6)]));
    assert!(said.contains("hard (light-matched) does not swim at all"), "{said}");
    assert!(said.contains("no swimming could be resolved in pcf-grid-11 (light-matched)"), "{said}");
    assert!(said.contains("pcf-vogel-16 (light-matched) swims most, SWIMMING (9.0 ± 1.0)×10⁻⁶"), "{said}");
    let said = say(&card(errors, [score(8e-6, 3e-6), score(7e-6, 3e-6), score(9e-6, 3e-6)]));
    assert!(said.contains("no difference in SWIMMING could be resolved"), "{said}");
    assert!(!said.contains("swims most"), "{said}");
}

#[test]
fn fidelity_paid_for_in_motion_is_said() {
    let errors = [score(0.03, 0.001), score(0.04, 0.001), score(0.05, 0.001)];
    let said = say(&card(errors, [score(9e-6, 1e-6), STILL, STILL]));
    let paid = "hard (light-matched) pays for it under motion: SWIMMING (9.0 ± 1.0)×10⁻⁶, \
                where pcf-grid-11 (light-matched) has none at an ERROR of 0.0400 ± 0.0010.";
    assert!(said.contains(paid), "{said}");
    let said = say(&card(errors, [score(9e-6, 1e-6), score(8e-6, 1e-6), score(9e-6, 1e-6)]));
    assert!(!said.contains("pays"), "{said}");
}

#[test]
fn what_was_not_measured_says_why() {
    let mut card = card([score(0.03, 0.001); 3], [STILL; 3]);
    for overall in &mut card.overall {
        overall.scores.insert("swimming".into(), Measured::no("not measured: one frame only"));
    }
    let said = say(&card);
    assert!(said.contains("SWIMMING was not measured: one frame only."), "{said}");
    assert!(said.contains("Cost was not measured: software adapter."), "{said}");
    for window in &mut card.windows {
        window.anchors = 0;
    }
    assert!(say(&card).contains("no anchors agreed in any view: check the camera"));
}

#[test]
fn budgets_name_a_dearer_variant_only_when_it_is_better() {
    let card = scorecard(Device::Gpu, (48, 27));
    let said = say(&card);
    assert!(said.contains("within 0.05 ms hard (light-matched)"), "{said}");
    assert!(said.contains("within 0.2 ms chss-mask (light-matched)"), "{said}");
    assert!(said.contains("nothing dearer is resolvably better"), "{said}");
    assert!(!said.contains("within 0.5 ms"), "{said}");
}

/// The fixture's card with one colonnade window and these differences of chss-mask and chss-min
/// (mask minus min, as the program stores them).
fn headline_card(swimming: Score, error: Score) -> Scorecard {
    let mut card = scorecard(Device::Software, (48, 27));
    card.paired.clear();
    let find = |name: &str| {
        let light_matched = |v: &&crate::VariantCard| v.calibration == crate::Calibration::LightMatched;
        card.variants.iter().filter(light_matched).find(|v| v.name == name).expect("in the fixture").clone()
    };
    let (mask, min) = (find("chss-mask"), find("chss-min"));
    let place = |wanted: &crate::VariantCard| card.variants.iter().position(|v| v == wanted).expect("there");
    let (a, b) = (place(&mask), place(&min));
    for window in &mut card.windows {
        window.scene = "elsewhere".into();
    }
    card.windows[0].scene = "colonnade".into();
    for (metric, difference) in [("swimming", swimming), ("error", error)] {
        let resolved = !difference.contains(0.0);
        card.paired.push(PairedCard { a, b, window: Some(0), metric: metric.into(), difference, resolved });
    }
    card
}

#[test]
fn the_document_s_own_comparison_is_answered_claim_by_claim() {
    // Stored as mask minus min: positive = the min filter is lower.
    let said = say(&headline_card(score(4e-5, 2e-5), score(0.03, 0.01)));
    assert!(
        said.contains("\"chss-min (light-matched) swims less than chss-mask (light-matched)\": holds on"),
        "{said}"
    );
    assert!(said.contains("\"The mask has the lower ERROR\": does not hold on"), "{said}");
    let said = say(&headline_card(score(4e-5, 5e-5), score(-0.03, 0.01)));
    assert!(said.contains("\": cannot be resolved on"), "{said}");
    assert!(said.contains("\"The mask has the lower ERROR\": holds on"), "{said}");
}

#[test]
fn the_planned_comparison_is_not_corrected_for_the_others() {
    let mut card = headline_card(score(4e-5, 2e-5), score(-0.03, 0.01));
    for pair in &mut card.paired {
        pair.resolved = false;
    }
    let said = say(&card);
    assert!(said.contains("swims less than chss-mask (light-matched)\": holds on"), "{said}");
    assert!(said.contains("\"The mask has the lower ERROR\": holds on"), "{said}");
    let mut card = headline_card(score(4e-5, 5e-5), score(-0.03, 0.01));
    for pair in &mut card.paired {
        pair.resolved = true;
    }
    assert!(say(&card).contains("\": cannot be resolved on"), "its own interval decides");
}

#[test]
fn both_shares_of_coverage_are_said() {
    let mut card = scorecard(Device::Software, (48, 27));
    card.windows[0].picture = 0.45;
    card.windows[0].coverage = 0.737;
    let both = "Scores cover 45.0\u{a0}% to 80.5\u{a0}% of the pictures: 73.7\u{a0}% to 94.7\u{a0}% of the \
                surface points that face the light; truth";
    assert!(say(&card).contains(both), "{}", say(&card));
    for window in &mut card.windows {
        window.picture = 0.0;
    }
    let older = "Scores cover 73.7\u{a0}% to 94.7\u{a0}% of the surface points that face the light; truth";
    assert!(say(&card).contains(older), "{}", say(&card));
}

#[test]
fn a_part_that_is_more_than_the_whole_is_nearly_all() {
    let mut card = card([score(0.03, 0.001), score(0.04, 0.001), score(0.05, 0.001)], [STILL; 3]);
    let best = &mut card.overall[0].scores;
    best.insert("mse".into(), score(9e-4, 1e-5).into());
    best.insert("noise".into(), score(9.1e-4, 1e-5).into());
    let said = say(&card);
    assert!(said.contains("nearly all is noise") && !said.contains("101"), "{said}");
    card.overall[0].scores.insert("noise".into(), score(7e-4, 1e-5).into());
    assert!(say(&card).contains("77.8\u{a0}% is noise"), "{}", say(&card));
}

#[test]
fn one_take_from_elsewhere_says_what_its_swimming_holds() {
    let mut card = card([score(0.03, 0.001), score(0.04, 0.001), score(0.05, 0.001)], [score(9e-6, 1e-6); 3]);
    assert!(!say(&card).contains("edge crawl"), "our own are read at anchors");
    card.variants[1].calibration = crate::Calibration::Elsewhere;
    assert!(say(&card).contains("SWIMMING here holds edge crawl"));
    card.overall[1].scores.insert("noise".into(), Measured::no("one take"));
    assert!(say(&card).contains("holds the noise of its one take, and edge crawl"), "{}", say(&card));
    card.overall[0].cost_note = Some("no cost: rendered elsewhere".into());
    assert!(say(&card).contains("Cost was not measured: rendered elsewhere."));
}
