//! `claims.md`: the table for the repository.

use super::card::{ClaimCard, ClaimPart, ClaimsCard, DocumentTime};
use super::words::{counts, effect, expectation, extent, facts, unmeasured, value};
use crate::numbers::number;
use crate::tables::markdown;

pub(super) fn markdown_of(card: &ClaimsCard) -> String {
    let mut text = String::from("# Claims of the seed documents, measured\n\n");
    let counted: Vec<String> = counts(card).iter().map(|(v, n)| format!("{} **{n}**", v.label())).collect();
    text += &counted.join(", ");
    text += ".\n\nThe rule and the margins: docs/claims.md, written before the results. Effects are A / B − 1 in percent, or \
             A − B where no unit is given, with 95 % intervals paired over tiles.\n\n";
    text += "| claim | says | verdict |\n|---|---|---|\n";
    for claim in &card.claims {
        let (id, says) = (markdown(&claim.id), markdown(&claim.statement));
        text += &format!("| [{id}](#{}) | {says} | {} |\n", claim.id.to_lowercase(), verdict(claim));
    }
    card.claims.iter().for_each(|claim| text += &section(claim));
    text += &times(&card.times);
    text += "\n## Provenance\n\n";
    for (name, fact) in facts(card) {
        text += &format!("- {name}: {}\n", markdown(&fact));
    }
    card.provenance.notes.iter().for_each(|note| text += &format!("- {}\n", markdown(note)));
    text + &format!("\n```\n{}\n```\n", card.provenance.command.replace('`', "'"))
}

fn section(claim: &ClaimCard) -> String {
    let mut text = format!(
        "\n## {}\n\n**{}** ({}): {}\n",
        markdown(&claim.id),
        verdict(claim),
        markdown(&claim.document),
        markdown(&claim.statement)
    );
    if let Some(note) = &claim.note {
        text += &format!("\n{}\n", markdown(note));
    }
    text += "\n| part | number | A | B | effect | expected | outcome | from |\n|---|---|---|---|---|---|---|---|\n";
    claim.parts.iter().for_each(|part| text += &row(part));
    if let (Some(file), Some(caption)) = (&claim.crop, &claim.crop_caption) {
        text += &format!("\n![{}]({file})\n\n{}\n", markdown(&claim.id), markdown(caption));
    }
    text
}

/// With how much of it was not measured.
fn verdict(claim: &ClaimCard) -> String {
    let open = unmeasured(claim).map(|open| format!(" ({open})")).unwrap_or_default();
    format!("{}{open}", claim.verdict.label())
}

fn row(part: &ClaimPart) -> String {
    let subject = |name: &str, score| {
        let value = value(score);
        if value.is_empty() { markdown(name) } else { format!("{}: {}", markdown(name), markdown(&value)) }
    };
    let mut places = part.places.join("; ");
    if !part.per_place.is_empty() {
        let each =
            part.per_place.iter().map(|p| format!("{} {}", p.place, effect(part.effect_kind, p.effect)));
        places = each.collect::<Vec<_>>().join("; ");
    }
    let reason = part.reason.as_ref().map(|r| format!(" ({})", markdown(r))).unwrap_or_default();
    let cells = [
        markdown(&part.says),
        markdown(&part.number),
        subject(&part.a, part.value_a),
        subject(&part.b, part.value_b),
        part.effect.map_or_else(|| "–".into(), |e| markdown(&effect(part.effect_kind, e))),
        markdown(&expectation(part)),
        format!("{}{reason}", part.outcome.label()),
        markdown(
            &[extent(part), places].into_iter().filter(|t| !t.is_empty()).collect::<Vec<_>>().join("; "),
        ),
    ];
    format!("| {} |\n", cells.join(" | "))
}

fn times(times: &[DocumentTime]) -> String {
    if times.is_empty() {
        return String::new();
    }
    let mut text = String::from(
        "\n## The first document's Table 1\n\nTimes on a GTX 660 at 1920x1080 with a 2048² map, and as ratios to the plain \
         filter beside ours.\n\n| what | document ms | document ratio | ours | ratio |\n|---|---:|---:|---|---:|\n",
    );
    for t in times {
        let ratio = t.ratio.map_or_else(
            || "needs a GPU".into(),
            |s| format!("{} [{} to {}]", number(s.value), number(s.low), number(s.high)),
        );
        text += &format!(
            "| {} | {} | {} | {} | {} |\n",
            markdown(&t.what),
            number(t.document_ms),
            number(t.document_ratio),
            markdown(&t.ours),
            markdown(&ratio)
        );
    }
    text
}
