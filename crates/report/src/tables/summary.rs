//! `summary.md`: the answer and the table, for a CI step summary or a pull request.

use super::escape::{code, markdown};
use crate::gate::{ACCEPT, GateCard, MEASURE};
use crate::numbers::free_score_about;
use crate::words::{Comparison, Sentence, Span, answer, plain_line};
use crate::{AdapterCard, Measured, Scorecard};
use umbrage_metrics::Verdict;

/// Step summaries above 1 MiB are cut off entirely; room is left for what others write there.
const MOST_BYTES: usize = 900 * 1024;

/// Failures that are written out.
const MOST_FAILURES: usize = 30;

/// Notes that are written out.
const MOST_NOTES: usize = 20;

/// Columns: metric id and head.
const COLUMNS: [(&str, &str); 6] = [
    ("error", "ERROR (RMSE)"),
    ("swimming", "SWIMMING"),
    ("noise", "noise"),
    ("light_leak", "light leak"),
    ("false_shadow", "false shadow"),
    ("width_ratio", "width"),
];

pub(crate) fn summary(card: &Scorecard, gate: Option<&GateCard>) -> String {
    let sentences = answer(card);
    let mut text = String::from("## Umbrage: ");
    text += &markdown(&card.provenance.suite);
    text += "\n\n";
    text += &gate.map(verdict).unwrap_or_default();
    for (i, sentence) in sentences.iter().enumerate() {
        text += &match i {
            0 => format!("**{}**\n\n", spans(sentence, false)),
            _ => format!("- {}\n", spans(sentence, true)),
        };
    }
    text += &table(card, MOST_BYTES - text.len().min(MOST_BYTES));
    let p = &card.provenance;
    let facts = format!(
        "\n{} on {}, {}x{}, T = {}, S = {}. Intervals are 95 %. Everything else: [index.html](index.html).\n",
        markdown(&format!("umbrage {}", p.tool_version)),
        markdown(&p.adapter.name),
        p.width,
        p.height,
        p.frames,
        p.seeds,
    );
    text += &notes(card);
    text + &facts
}

/// What a reader of another program's frames must know: how the cameras were checked, what a format's steps do.
fn notes(card: &Scorecard) -> String {
    if card.provenance.adapter.device_type != AdapterCard::ELSEWHERE {
        return String::new();
    }
    let all = card.provenance.notes.iter().chain(card.windows.iter().flat_map(|w| &w.notes));
    let mut said: Vec<&String> = Vec::new();
    for note in all {
        if !said.contains(&note) {
            said.push(note);
        }
    }
    let more = said.len().saturating_sub(MOST_NOTES);
    let mut text: String = said.iter().take(MOST_NOTES).map(|n| format!("\n- {}", markdown(n))).collect();
    if more > 0 {
        text += &format!("\n- {more} more notes are on the page");
    }
    text + "\n"
}

/// What the gate says, the failures first.
fn verdict(gate: &GateCard) -> String {
    let mut text = format!("**Gate against {}: {}**\n\n", markdown(&gate.baseline), gate.counts());
    let failed: Vec<_> = gate.with(Verdict::Regressed).collect();
    for (case, _) in failed.iter().take(MOST_FAILURES) {
        let head = format!("{}, {}: {}", case.place(), case.variant, case.sentence());
        text += &format!("- {}\n", markdown(&head));
        for line in case.details(gate) {
            // What is to be copied is not escaped.
            let copied = [MEASURE, ACCEPT].iter().find_map(|head| Some((head, line.strip_prefix(head)?)));
            text += &match copied {
                Some((head, command)) => format!("  - {head}{}\n", code(command)),
                None => format!("  - {}\n", markdown(&line)),
            };
        }
    }
    if failed.len() > MOST_FAILURES {
        text += &format!("- {} more are in junit.xml\n", failed.len() - MOST_FAILURES);
    }
    if !gate.new.is_empty() {
        text += &format!("- not in the baseline: {}\n", markdown(&gate.new.join(", ")));
    }
    for change in &gate.margins_changed {
        text += &format!("- margin changed: {}\n", markdown(change));
    }
    text + "\n"
}

/// Numbers in bold, unless all of it is.
fn spans(sentence: &Sentence, emphasise: bool) -> String {
    let part = |s: &Span| match s {
        Span::Number(t) if emphasise => format!("**{}**", markdown(t)),
        Span::Text(t) | Span::Number(t) | Span::Link(_, t) => markdown(t),
    };
    sentence.0.iter().map(part).collect()
}

/// As many rows as fit.
fn table(card: &Scorecard, most_bytes: usize) -> String {
    let all = Comparison { card, window: None };
    let crawls = card.metrics.iter().any(|m| m.id == "swimming" && m.name.contains("edge crawl"));
    let head = |(id, head): (&'static str, &'static str)| match id {
        "swimming" if crawls => "SWIMMING with edge crawl",
        _ => head,
    };
    let heads: Vec<&str> = COLUMNS.into_iter().map(head).collect();
    let mut text = format!(
        "\n| variant | {} | GPU ms | |\n|---|{}---:|---|\n",
        heads.join(" | "),
        "---:|".repeat(COLUMNS.len())
    );
    for (v, variant) in card.variants.iter().enumerate() {
        let mut cells = vec![markdown(&format!("{} ({})", variant.name, variant.calibration.label()))];
        for (id, _) in COLUMNS {
            cells.push(cell(all.scores(v).and_then(|s| s.get(id)), card.goal(id), all.group(v, id)));
        }
        let cost = card.overall_of(v).and_then(|o| o.cost.as_ref());
        cells.push(cost.map_or_else(|| "–".into(), |c| crate::numbers::number(c.frame_ms_median)));
        cells.push(all.scores(v).map_or_else(|| "not measured".into(), |s| markdown(&plain_line(s))));
        let row = format!("| {} |\n", cells.join(" | "));
        if text.len() + row.len() > most_bytes {
            return text + &format!("\n{} more variants are on the page.\n", card.variants.len() - v);
        }
        text += &row;
    }
    text
}

fn cell(measured: Option<&Measured>, goal: f64, letters: Option<&str>) -> String {
    match measured {
        Some(Measured::Score(score)) => {
            let letters = letters.map(|l| format!(" {}", markdown(l))).unwrap_or_default();
            markdown(&free_score_about(*score, goal)) + &letters
        }
        Some(Measured::NotMeasured { not_measured }) => markdown(not_measured),
        None => "–".into(),
    }
}
