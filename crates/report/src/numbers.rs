//! Numbers as a reader sees them: three significant digits, no more than the interval carries,
//! the power of ten in the header.

use umbrage_metrics::Score;

/// A power of ten, a multiple of three, shared by a column or an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Power(i32);

impl Power {
    /// No power: numbers as they are.
    pub(crate) const ONE: Self = Self(0);

    /// The one that brings the largest magnitude between 1 and 1000.
    pub(crate) fn of(values: impl Iterator<Item = f64>) -> Self {
        let largest = values.map(f64::abs).filter(|v| v.is_finite()).fold(0.0, f64::max);
        // Rounding to three digits may carry: 999.7 reads 1000.
        let exponent = if largest < 1e-30 { 0.0 } else { (largest * 1.0005).log10() };
        // Numbers that read well as they are stay so.
        if (-1.0..3.0).contains(&exponent) { Self(0) } else { Self((exponent / 3.0).floor() as i32 * 3) }
    }

    /// For one number in a sentence: decimals down to a thousandth, powers beyond.
    fn in_text(value: f64) -> Self {
        let size = value.abs();
        if size < 1e-30 || (1e-3..1e5).contains(&size) {
            return Self::ONE;
        }
        // From 0.1 to 100: 0.82×10⁻⁶ sits better beside 17.4×10⁻⁶ than 820×10⁻⁹ does.
        Self(((size.log10() + 1.0) / 3.0).floor() as i32 * 3)
    }

    /// The number to print.
    pub(crate) fn scaled(self, value: f64) -> f64 {
        value / 10f64.powi(self.0)
    }

    /// The exponent of ten.
    pub(crate) fn exponent(self) -> i32 {
        self.0
    }

    /// For a header: "10⁻⁶", empty for 1.
    pub(crate) fn label(self) -> String {
        if self.0 == 0 { String::new() } else { format!("10{}", superscript(self.0)) }
    }
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]);
    exponent.to_string().chars().map(digit).collect()
}

/// Half the width of the interval.
pub(crate) fn half_width(score: Score) -> f64 {
    if is_unknown(score) {
        return 0.0;
    }
    0.5 * (score.high - score.low).abs()
}

/// With fewer than two clusters of tiles nothing is known about the spread: the metrics crate says so by the
/// value and 1 on either side (`Bootstrap`).
fn is_unknown(score: Score) -> bool {
    let is_one = |side: f64| (side - 1.0).abs() < 1e-9;
    is_one(score.value - score.low) && is_one(score.high - score.value)
}

/// Three significant digits: "0.0123", "1.84", "335", "−2.10"; zero is "0".
pub(crate) fn number(value: f64) -> String {
    fixed(value, decimals(value))
}

/// As [`number`], with the power of ten written out when it does not read well without: "4.20×10⁻⁶".
pub(crate) fn free_number(value: f64) -> String {
    let power = Power::in_text(value);
    if power == Power::ONE {
        return number(value);
    }
    format!("{}×{}", number(power.scaled(value)), power.label())
}

/// A score and its interval: "1.84" and "± 0.12", or "1.12" and "[1.02 to 3.3]" where a symmetric
/// "±" would contradict the interval about the score's `goal` (0, or 1 of a ratio). An exact one
/// (no width) is the number alone.
pub(crate) fn with_interval(score: Score, goal: f64, power: Power) -> (String, Option<String>) {
    let (value, half) = (power.scaled(score.value), power.scaled(half_width(score)));
    if is_unknown(score) {
        return (number(value), Some("± unknown".into()));
    }
    if half == 0.0 || half.abs() < 1e-9 * value.abs() {
        return (number(value), None);
    }
    if hides_its_side(score, goal) {
        return with_ends(score, goal, power);
    }
    // A digit beyond the second of the half-width says nothing.
    let places = decimals(value).min(decimals(half) - 1).clamp(0, 12);
    let shown = fixed(half, places);
    let lost = shown.chars().all(|c| matches!(c, '0' | '.'));
    let half = if lost { fixed(half, decimals(half) - 2) } else { shown };
    (fixed(value, places), Some(format!("± {half}")))
}

/// The value and both ends of its interval.
fn with_ends(score: Score, goal: f64, power: Power) -> (String, Option<String>) {
    let [value, low, high, goal] = [score.value, score.low, score.high, goal].map(|v| power.scaled(v));
    // The second digit of its distance from the value, and at least the first from the goal:
    // an end beside 1 must not read 1.00.
    let places = |end: f64| {
        let from_goal = if end == goal { 0 } else { decimals(end - goal) - 2 };
        (decimals(end - value) - 1).max(from_goal).clamp(0, 12)
    };
    let ends = format!("[{} to {}]", fixed(low, places(low)), fixed(high, places(high)));
    (fixed(value, places(low).max(places(high))), Some(ends))
}

/// As [`with_interval`] about 0, in one string and with the power written out.
pub(crate) fn free_score(score: Score) -> String {
    free_score_about(score, 0.0)
}

/// As [`free_score`], of a score whose goal is not always 0.
pub(crate) fn free_score_about(score: Score, goal: f64) -> String {
    let power = Power::in_text(score.value.abs().max(half_width(score)));
    let label = power.label();
    match with_interval(score, goal, power) {
        (value, None) if label.is_empty() => value,
        (value, Some(interval)) if label.is_empty() => format!("{value} {interval}"),
        (value, None) => format!("{value}×{label}"),
        (value, Some(ends)) if ends.starts_with('[') => format!("{value} {ends}×{label}"),
        (value, Some(half)) => format!("({value} {half})×{label}"),
    }
}

/// Whether a symmetric "±" would say the opposite of the interval about the goal (bootstrap
/// intervals of small counts lean to one side).
fn hides_its_side(score: Score, goal: f64) -> bool {
    let half = half_width(score);
    let resolved = score.low > goal || score.high < goal;
    let looks_resolved = score.value - half > goal || score.value + half < goal;
    resolved != looks_resolved && half > 0.0 && score.value != goal
}

/// A change in percent, as one would say it: "9 %", "0.6 %".
pub(crate) fn spoken_percent(share: f64) -> String {
    let percent = 100.0 * share;
    format!("{}\u{a0}%", fixed(percent, if percent.abs() < 1.95 { 1 } else { 0 }))
}

/// A whole number in groups of three: "104 311".
pub(crate) fn count(value: u64) -> String {
    let digits = value.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    let groups: Vec<String> = groups.map(|g| String::from_utf8_lossy(g).into_owned()).collect();
    groups.join("\u{202f}")
}

/// A share of one as a percentage: "97.2 %".
pub(crate) fn percent(share: f64) -> String {
    format!("{}\u{a0}%", number(100.0 * share))
}

/// Decimals that show three significant digits.
fn decimals(value: f64) -> i32 {
    if value.abs() < 1e-30 {
        return 0;
    }
    // 9.996 has to be read as 10.0: one decimal less than 9.99.
    let exponent = (value.abs() * 1.000_5).log10().floor() as i32;
    (2 - exponent).clamp(0, 12)
}

/// With a true minus sign, and no minus before a zero.
fn fixed(value: f64, decimals: i32) -> String {
    if value.abs() < 1e-30 {
        return "0".into();
    }
    let text = format!("{:.*}", decimals.max(0) as usize, value);
    let zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if zero { text.replace('-', "") } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn score(value: f64, half: f64) -> Score {
        Score { value, low: value - half, high: value + half }
    }

    #[test]
    fn an_interval_that_is_not_known_is_no_number() {
        assert_eq!(free_score(score(0.0134, 1.0)), "0.0134 ± unknown");
        assert_eq!(free_score(score(9.1e-5, 1.0)), "(91.0 ± unknown)×10⁻⁶");
    }

    #[test]
    fn three_significant_digits() {
        let texts = [0.012_345, 1.843, 335.4, -2.1, 0.0, 12_345.0, 9.996, 1e-40].map(number);
        assert_eq!(texts, ["0.0123", "1.84", "335", "−2.10", "0", "12345", "10.0", "0"]);
    }

    #[test]
    fn digits_stop_where_the_interval_does() {
        let text = |value, half| {
            let (value, half) = with_interval(score(value, half), 0.0, Power::ONE);
            half.map_or(value.clone(), |h| format!("{value} {h}"))
        };
        assert_eq!(text(1.8432, 0.1234), "1.84 ± 0.12");
        assert_eq!(text(-0.0003, 0.8), "0.00 ± 0.80");
        assert_eq!(text(123.4, 25.0), "123 ± 25");
        assert_eq!(text(3.0, 0.0), "3.00");
        assert_eq!(text(0.0429, 0.000_75), "0.0429 ± 0.0008");
        assert_eq!(text(123.0, 0.04), "123 ± 0.04", "a small half-width is not a zero");
    }

    #[test]
    fn powers_go_by_threes_and_stay_out_of_the_way() {
        let label = |v: f64| Power::of(std::iter::once(v)).label();
        assert_eq!([3.2e-6, 0.0421, 0.7, 12.0, 4.2e-4, 0.0].map(label), ["10⁻⁶", "10⁻³", "", "", "10⁻⁶", ""]);
        assert_eq!(free_score(score(4.2e-6, 3e-7)), "(4.20 ± 0.30)×10⁻⁶");
        assert_eq!(free_score(score(0.0429, 0.000_75)), "0.0429 ± 0.0008");
        assert_eq!(free_score(score(8.2e-7, 9.2e-7)), "(0.82 ± 0.92)×10⁻⁶");
        let leaning = Score { value: -1.5e-4, low: -3.5e-4, high: -1e-5 };
        assert_eq!(
            free_score(leaning),
            "−0.15 [−0.35 to −0.01]×10⁻³",
            "± 170 would say that it is unresolved"
        );
        assert_eq!(free_number(0.000_012_3), "12.3×10⁻⁶");
        assert_eq!([7, 1234, 1_104_311].map(count), ["7", "1\u{202f}234", "1\u{202f}104\u{202f}311"]);
        assert_eq!([0.091, 0.0061, 0.0194].map(spoken_percent), ["9\u{a0}%", "0.6\u{a0}%", "1.9\u{a0}%"]);
    }

    #[test]
    fn a_leaning_interval_shows_its_ends_where_its_goal_asks_for_it() {
        let wide = Score { value: 1.12, low: 1.016, high: 3.33 };
        assert_eq!(free_score_about(wide, 1.0), "1.12 [1.02 to 3.3]", "± 1.2 would say that 1 is possible");
        assert_eq!(free_score_about(Score { low: 1.0004, ..wide }, 1.0), "1.1200 [1.0004 to 3.3]");
        let near = Score { value: 0.9, low: 0.86, high: 1.02 };
        assert_eq!(free_score_about(near, 1.0), "0.900 [0.860 to 1.02]", "± 0.08 would say that 1 is not");
        assert_eq!(free_score_about(near, 0.0), "0.900 ± 0.080");
        assert_eq!(free_score_about(score(1.12, 0.04), 1.0), "1.12 ± 0.04");
    }
}
