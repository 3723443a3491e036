//! Effects, places and counts as both pages say them.

use super::card::{ClaimCard, ClaimPart, ClaimsCard, EffectKind, Outcome, Verdict};
use crate::numbers::{Power, free_number, free_score, number};
use umbrage_metrics::Score;

/// "−23.1 % [−25.0 to −21.2]", or the difference in the number's own unit.
pub(super) fn effect(kind: EffectKind, score: Score) -> String {
    let ends = [score.value, score.low, score.high];
    let (power, unit) = match kind {
        EffectKind::Ratio => (Power::ONE, "\u{a0}%".to_string()),
        EffectKind::Difference => {
            let power = Power::of(ends.into_iter());
            let label = power.label();
            (power, if label.is_empty() { label } else { format!("×{label}") })
        }
    };
    let times = if kind == EffectKind::Ratio { 100.0 } else { 1.0 };
    let [value, low, high] = ends.map(|v| signed(power.scaled(times * v)));
    if score.low == score.high {
        format!("{value}{unit}")
    } else {
        format!("{value}{unit} [{low} to {high}]")
    }
}

fn signed(value: f64) -> String {
    if value > 0.0 { format!("+{}", number(value)) } else { number(value) }
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

/// "4 seeds, 16 frames, 212 tiles"; nothing for a time that was not taken.
pub(super) fn extent(part: &ClaimPart) -> String {
    let seeds = if part.seeds == 1 { "1 seed".into() } else { format!("{} seeds", part.seeds) };
    match (part.seeds, part.frames, part.places.is_empty()) {
        (0, 0, true) => "exact".into(),
        (0, 0, false) => String::new(),
        (0, repeats, _) => format!("{repeats} repeats"),
        (_, frames, _) => format!("{seeds}, {frames} frames, {} tiles", part.tiles),
    }
}

/// "2 of 5 parts not measured", or nothing.
pub(super) fn unmeasured(claim: &ClaimCard) -> Option<String> {
    let open = claim.parts.iter().filter(|p| matches!(p.outcome, Outcome::NeedsGpu | Outcome::NotMeasured));
    let open = open.count();
    (open > 0).then(|| format!("{open} of {} parts not measured", claim.parts.len()))
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
