//! Effects, places and counts as both pages say them.

use super::card::{ClaimPart, ClaimsCard, EffectKind, Verdict};
use crate::numbers::{free_number, free_score, number};
use umbrage_metrics::Score;

/// "−23.1 % [−25.0 to −21.2]", or the difference in the number's own unit.
pub(super) fn effect(kind: EffectKind, score: Score) -> String {
    let shown: fn(f64) -> String = match kind {
        EffectKind::Ratio => |v| number(100.0 * v),
        EffectKind::Difference => free_number,
    };
    let unit = if kind == EffectKind::Ratio { "\u{a0}%" } else { "" };
    let sign = |v: f64| if v > 0.0 { format!("+{}", shown(v)) } else { shown(v) };
    if score.low == score.high {
        return format!("{}{unit}", sign(score.value));
    }
    format!("{}{unit} [{} to {}]", sign(score.value), sign(score.low), sign(score.high))
}

/// "below −5 %".
pub(super) fn expectation(part: &ClaimPart) -> String {
    let margin = match part.effect_kind {
        EffectKind::Ratio => format!("{}\u{a0}%", number(100.0 * part.margin)),
        EffectKind::Difference => free_number(part.margin),
    };
    let zero = part.margin == 0.0;
    match part.expect.as_str() {
        "equal" if zero => "equal".into(),
        "equal" => format!("within ±{margin}"),
        "below" if zero => "below 0".into(),
        "below" | "not below" => format!("{} −{margin}", part.expect),
        expect if zero => format!("{expect} 0"),
        expect => format!("{expect} +{margin}"),
    }
}

/// The number of a subject, or nothing.
pub(super) fn value(score: Option<Score>) -> String {
    score.map_or_else(String::new, free_score)
}

/// "4 seeds, 16 frames, 212 tiles".
pub(super) fn extent(part: &ClaimPart) -> String {
    match (part.seeds, part.frames) {
        (0, 0) => "exact".into(),
        (0, repeats) => format!("{repeats} repeats"),
        (seeds, frames) => format!("{seeds} seeds, {frames} frames, {} tiles", part.tiles),
    }
}

/// How often each verdict was given, those that were not given left out.
pub(super) fn counts(card: &ClaimsCard) -> Vec<(Verdict, usize)> {
    let count = |verdict| card.claims.iter().filter(|c| c.verdict == verdict).count();
    Verdict::ALL.into_iter().map(|v| (v, count(v))).filter(|(_, n)| *n > 0).collect()
}

/// Facts for the foot of both pages.
pub(super) fn facts(card: &ClaimsCard) -> Vec<(&'static str, String)> {
    let p = &card.provenance;
    let mut facts = vec![
        ("Adapter", p.adapter.name.clone()),
        ("Driver", format!("{}, {} ({})", p.adapter.driver, p.adapter.backend, p.adapter.device_type)),
        ("Program", format!("umbrage {}", p.tool_version)),
        ("Started", p.date.clone()),
        ("Picture", format!("{} × {} px, shadow map {}²", p.width, p.height, p.shadow_map_texels)),
        ("Window", format!("T = {} frames, S = {} seeds", p.frames, p.seeds)),
        ("Truth", format!("2 × {} samples a point", p.samples_per_half)),
    ];
    facts.push(match &p.costs {
        Some(c) => (
            "Costs",
            format!(
                "{}, {}, {} × {} px, shadow map {}², {}, `{}`",
                c.adapter, c.driver, c.width, c.height, c.shadow_map_texels, c.date, c.command
            ),
        ),
        None => ("Costs", "need a GPU: not measured".into()),
    });
    facts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn effects_carry_sign_and_unit() {
        let score = Score { value: -0.231, low: -0.25, high: 0.012 };
        assert_eq!(effect(EffectKind::Ratio, score), "−23.1\u{a0}% [−25.0 to +1.20]");
        assert_eq!(effect(EffectKind::Difference, Score::exact(2e-6)), "+2.00×10⁻⁶");
    }
}
