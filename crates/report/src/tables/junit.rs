//! `junit.xml`. Of a gated run one case per scene, path, variant and score; otherwise one per scene, path and
//! variant: measured passes, not measured is skipped and says why.

use super::escape::xml;
use crate::gate::{GateCard, GateCase};
use crate::{Measured, Scorecard};
use std::fmt::Write as _;
use umbrage_metrics::Verdict;

/// A case and what became of it.
struct Case {
    class: String,
    name: String,
    outcome: Outcome,
}

enum Outcome {
    Passed(Option<String>),
    Skipped(String),
    Failed { message: String, text: String },
}

pub(crate) fn junit(card: &Scorecard, gate: Option<&GateCard>) -> String {
    let cases = match gate {
        Some(gate) => gate.cases.iter().map(|case| gated(case, gate)).collect(),
        None => measured(card),
    };
    let count = |of: fn(&Outcome) -> bool| cases.iter().filter(|c| of(&c.outcome)).count();
    let counts = format!(
        "tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\"",
        cases.len(),
        count(|o| matches!(o, Outcome::Failed { .. })),
        count(|o| matches!(o, Outcome::Skipped(_)))
    );
    let mut text = String::new();
    for Case { class, name, outcome } in &cases {
        let head = format!("    <testcase classname=\"{}\" name=\"{}\"", xml(class), xml(name));
        // Writing to a string cannot fail.
        let _ = match outcome {
            Outcome::Passed(None) => writeln!(text, "{head}/>"),
            Outcome::Passed(Some(note)) => {
                writeln!(text, "{head}><system-out>{}</system-out></testcase>", xml(note))
            }
            Outcome::Skipped(reason) => {
                writeln!(text, "{head}><skipped message=\"{}\"/></testcase>", xml(reason))
            }
            Outcome::Failed { message, text: more } => writeln!(
                text,
                "{head}><failure message=\"{}\">{}</failure></testcase>",
                xml(message),
                xml(more)
            ),
        };
    }
    let suite = xml(&card.provenance.suite);
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"umbrage\" {counts}>\n  \
         <testsuite name=\"{suite}\" {counts}>\n{text}  </testsuite>\n</testsuites>\n"
    )
}

fn gated(case: &GateCase, gate: &GateCard) -> Case {
    let class = match (&case.scene, &case.path, case.first_frame) {
        (Some(scene), Some(path), Some(first)) => format!("{scene}.{path}.{first}"),
        _ => "all-windows".into(),
    };
    let outcome = match &case.change {
        None => Outcome::Skipped("not defined here, nor in the baseline".into()),
        Some(change) => match change.verdict {
            Verdict::Unchanged => Outcome::Passed(None),
            Verdict::Improved | Verdict::Inconclusive => {
                Outcome::Passed(Some(format!("{:?}: {}", change.verdict, case.sentence())))
            }
            Verdict::Regressed => {
                Outcome::Failed { message: case.sentence(), text: case.details(gate).join("\n") }
            }
        },
    };
    Case { class, name: format!("{} {}", case.variant, case.metric), outcome }
}

fn measured(card: &Scorecard) -> Vec<Case> {
    let mut cases = Vec::new();
    for (w, window) in card.windows.iter().enumerate() {
        for (v, variant) in card.variants.iter().enumerate() {
            cases.push(Case {
                class: format!("{}.{}.{}", window.scene, window.path, window.first_frame),
                name: format!("{} ({})", variant.name, variant.calibration.label()),
                outcome: why_not(card, w, v).map_or(Outcome::Passed(None), Outcome::Skipped),
            });
        }
    }
    cases
}

fn why_not(card: &Scorecard, window: usize, variant: usize) -> Option<String> {
    let Some(result) = card.result(window, variant) else { return Some("not measured: no result".into()) };
    match result.scores.get("error") {
        Some(Measured::Score(_)) => None,
        Some(Measured::NotMeasured { not_measured }) => Some(format!("not measured: {not_measured}")),
        None => Some("not measured: no ERROR".into()),
    }
}
