//! Results against plain twins: within a band of what they say of receivers that are moved a little.

use crate::twins::plain::Spot;

/// The comparison of many results with bands of plain answers.
#[derive(Debug, Default)]
pub(crate) struct Bands {
    pub(crate) compared: usize,
    /// Results that the receiver's own answer does not hold.
    pub(crate) wide: usize,
    /// Results outside of their bands.
    pub(crate) outside: Vec<String>,
}

/// What single precision may add to a mean of weighted comparisons beyond the receiver's place: a
/// weight of a bilinear tap is known to 1e-4 (a place of 500 texels to 6e-5), the rest to 1e-6.
const TOLERANCE: f64 = 5e-4;

/// Least and largest of several answers.
fn band(answers: &[f64]) -> std::ops::RangeInclusive<f64> {
    let low = answers.iter().copied().fold(f64::INFINITY, f64::min);
    let high = answers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    low - TOLERANCE..=high + TOLERANCE
}

impl Bands {
    /// A result against what a twin says of its receiver and of those round it.
    pub(crate) fn compare(&mut self, value: f32, spot: &Spot, twin: impl Fn(&Spot) -> Vec<f64>) {
        self.compared += 1;
        let mut answers = twin(spot);
        // Most need no second question.
        if band(&answers).contains(&f64::from(value)) {
            return;
        }
        self.wide += 1;
        answers.extend(spot.jittered().iter().flat_map(twin));
        let band = band(&answers);
        if !band.contains(&f64::from(value)) {
            self.outside.push(format!("{value} is not in {band:?}"));
        }
    }

    /// Fails where more results lie outside of their bands than unlucky roundings make: a band of
    /// eleven answers does not hold every outcome of a comparison at a blocker's border. Limits are
    /// shares of all results.
    pub(crate) fn check(&self, what: &str, [most_outside, most_wide]: [f64; 2]) {
        let share = |n: usize| n as f64 / self.compared as f64;
        let some: Vec<_> = self.outside.iter().take(5).collect();
        assert!(self.compared > 800, "{what}: only {} compared", self.compared);
        assert!(
            share(self.outside.len()) <= most_outside,
            "{what}: {} of {} are outside: {some:#?}",
            self.outside.len(),
            self.compared
        );
        assert!(share(self.wide) <= most_wide, "{what}: {:.3} needed a band", share(self.wide));
    }
}
