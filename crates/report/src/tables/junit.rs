//! `junit.xml`: one case per scene, path and variant. Measured passes, not measured is skipped and
//! says why: whether a score is good enough is the gate's question, not this file's.

use super::escape::xml;
use crate::{Measured, Scorecard};
use std::fmt::Write as _;

pub(crate) fn junit(card: &Scorecard) -> String {
    let mut cases = String::new();
    let (mut tests, mut skipped) = (0, 0);
    for (w, window) in card.windows.iter().enumerate() {
        for (v, variant) in card.variants.iter().enumerate() {
            let reason = why_not(card, w, v);
            tests += 1;
            skipped += usize::from(reason.is_some());
            let class = xml(&format!("{}.{}.{}", window.scene, window.path, window.first_frame));
            let name = xml(&format!("{} ({})", variant.name, variant.calibration.label()));
            // Writing to a string cannot fail.
            let _ = match reason {
                None => writeln!(cases, "    <testcase classname=\"{class}\" name=\"{name}\"/>"),
                Some(reason) => writeln!(
                    cases,
                    "    <testcase classname=\"{class}\" name=\"{name}\"><skipped message=\"{}\"/></testcase>",
                    xml(&reason)
                ),
            };
        }
    }
    let suite = xml(&card.provenance.suite);
    let counts = format!("tests=\"{tests}\" failures=\"0\" errors=\"0\" skipped=\"{skipped}\"");
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"umbrage\" {counts}>\n  \
         <testsuite name=\"{suite}\" {counts}>\n{cases}  </testsuite>\n</testsuites>\n"
    )
}

fn why_not(card: &Scorecard, window: usize, variant: usize) -> Option<String> {
    let Some(result) = card.result(window, variant) else { return Some("not measured: no result".into()) };
    match result.scores.get("error") {
        Some(Measured::Score(_)) => None,
        Some(Measured::NotMeasured { not_measured }) => Some(format!("not measured: {not_measured}")),
        None => Some("not measured: no ERROR".into()),
    }
}
