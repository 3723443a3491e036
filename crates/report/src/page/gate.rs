//! What the gate says.

use crate::gate::{BEFORE, ChangeCard, GateCard, GateCase, short, short_up};
use maud::{Markup, html};
use std::collections::BTreeMap;
use umbrage_metrics::Verdict;

/// Rows that are shown of those that did not change.
const MOST_QUIET: usize = 400;

/// One word for the whole gate.
pub(super) fn chip(gate: &GateCard) -> Markup {
    let count = |verdict| gate.with(verdict).count();
    let (regressed, improved) = (count(Verdict::Regressed), count(Verdict::Improved));
    let (class, word) = match (regressed, improved) {
        (0, 0) => ("chip same", "Nothing regressed".to_string()),
        (0, n) => ("chip good", format!("{n} improved, nothing regressed")),
        (n, _) => ("chip bad", format!("{n} regressed")),
    };
    html! { span class=(class) { (word) " against " (gate.baseline) } }
}

pub(super) fn section(gate: &GateCard, crops: &BTreeMap<String, String>) -> Markup {
    use Verdict::{Improved, Inconclusive, Regressed, Unchanged};
    html! {
        section #gate {
            h2 { "Gate" }
            p.lede {
                "Compared with " (gate.baseline) " (umbrage " (gate.base.tool_version) ", " (gate.base.date) "): " (gate.counts())
                ". Same tiles, frames and number of seeds on both sides; what may fail is corrected for the number of comparisons. "
                "Accept this run with " code { (gate.accept) } "."
            }
            (thresholds())
            @if !gate.new.is_empty() { p.note { "Not in the baseline: " (gate.new.join(", ")) "." } }
            @for change in &gate.margins_changed { p.note { "Margin changed: " (change) "." } }
            @for (verdict, title, open) in [
                (Regressed, "Regressed", true),
                (Improved, "Improved", true),
                (Inconclusive, "Inconclusive", false),
                (Unchanged, "Unchanged", false),
            ] {
                @let cases: Vec<_> = gate.with(verdict).collect();
                @if !cases.is_empty() {
                    details open[open] {
                        summary { (title) " (" (cases.len()) ")" }
                        (table((gate, crops), &cases))
                    }
                }
            }
        }
    }
}

/// Filled by the script: what would fail with wider or narrower margins.
fn thresholds() -> Markup {
    html! {
        div.thresholds hidden {
            h3 { "What if the margins were others?" }
            p {
                label { "Margins from 1/16 to 16 times as wide " input type="range" min="-4" max="4" step="0.25" value="0"; }
                " " label { "of " select { option value="" { "all scores" } } }
            }
            p.says aria-live="polite" {}
            ul {}
            p.note { "At these margins: what the gate failed. At others each score is judged by itself, without the correction for many comparisons: the gate may fail fewer." }
        }
    }
}

#[derive(serde::Serialize)]
struct Case {
    place: String,
    variant: String,
    metric: String,
    margin: f64,
    pass_at: f64,
    /// At its own margin, with the correction for all comparisons.
    regressed: bool,
}

/// Every case that was judged, as JSON.
pub(super) fn cases(gate: &GateCard) -> String {
    let judged = gate.cases.iter().filter_map(|case| Some((case, case.change.as_ref()?)));
    let case = |(case, change): (&GateCase, &ChangeCard)| Case {
        place: case.place(),
        variant: case.variant.clone(),
        metric: case.metric.clone(),
        margin: change.margin,
        pass_at: change.would_pass_at,
        regressed: change.verdict == Verdict::Regressed,
    };
    // Strings and numbers alone: it cannot fail.
    serde_json::to_string(&judged.map(case).collect::<Vec<_>>()).unwrap_or_default()
}

fn table(
    (gate, crops): (&GateCard, &BTreeMap<String, String>),
    cases: &[(&GateCase, &ChangeCard)],
) -> Markup {
    html! {
        div.wide { table.plain.gate {
            thead { tr {
                th { "where" } th { "variant" } th { "score" }
                th.num { "baseline" } th.num { "now" } th.num { "worse by" } th.num { "95 %" }
                th.num { "margin" } th.num { "would pass at" } th.num { "caught from" } th { "where, how" }
            } }
            tbody {
                @for (case, c) in cases.iter().take(MOST_QUIET) { tr {
                    td { (case.place()) } td { (case.variant) } td { (case.metric.replace('_', " ")) }
                    td.num { (short(c.base)) } td.num { (short(c.now)) } td.num { (short(c.harm.value)) }
                    td.num { (short(c.harm.low)) " to " (short(c.harm.high)) }
                    td.num { (short(c.margin)) } td.num { (short_up(c.would_pass_at)) } td.num { (short(c.caught)) }
                    td { (more((gate, crops), case, c)) }
                } }
            }
        } }
        @if cases.len() > MOST_QUIET { p.note { (cases.len() - MOST_QUIET) " more are in gate.json." } }
    }
}

fn shows(case: &GateCase) -> String {
    match case.crop_shows.is_empty() {
        // A gate of an older version.
        true => format!("truth, {}", case.variant),
        false => case.crop_shows.join(", "),
    }
}

fn more(
    (gate, crops): (&GateCard, &BTreeMap<String, String>),
    case: &GateCase,
    change: &ChangeCard,
) -> Markup {
    html! {
        @match change.verdict {
            Verdict::Regressed => details {
                summary { "where, how" }
                @if let Some(source) = case.crop.as_ref().and_then(|file| crops.get(file)) {
                    @let what = format!("The worst place, left to right: {}", shows(case));
                    figure { img src=(source) alt=(what) loading="lazy"; figcaption { (what) "." } }
                    @if !case.crop_shows.iter().any(|s| s == BEFORE) {
                        p.note {
                            "No picture of before: a committed baseline holds sums, not pictures. Keep the base run's folder, then "
                            code { "umbrage compare FOLDER RUN" } "."
                        }
                    }
                } @else if case.scene.is_none() {
                    p.note { "Over all windows there is no one place to show: see its windows." }
                } @else {
                    p.note { "No picture: of many that regressed the first are shown, and a run without pictures has none." }
                }
                ul { @for line in case.details(gate) { li { (line) } } }
            },
            Verdict::Inconclusive => @if let Some(times) = change.needs_times { (format!("{times:.1} x the seeds would decide")) },
            _ => {},
        }
    }
}
