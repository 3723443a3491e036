//! Comparisons of medians of repeated timings, with intervals over the repeats.
//!
//! Blind spot: repeats on one machine in one minute say nothing about another card or clock.

use crate::interval::summary;
use crate::rng::Rng;
use crate::{Bootstrap, MetricsError, Score};

/// Numbers made of the samples' medians, each with its interval; every sample is resampled on its own.
///
/// # Errors
/// An empty sample.
pub fn compare_medians(
    samples: &[&[f64]],
    statistic: impl Fn(&[f64]) -> Vec<f64>,
    bootstrap: &Bootstrap,
) -> Result<Vec<Score>, MetricsError> {
    if samples.iter().any(|s| s.is_empty()) {
        return Err(MetricsError::Zero("the number of repeats"));
    }
    let values = statistic(&samples.iter().map(|s| median(s.to_vec())).collect::<Vec<_>>());
    let draw = |replicate: u32| {
        let mut rng = Rng::new(bootstrap.seed, u64::from(replicate));
        let medians: Vec<f64> = samples.iter().map(|s| median(resampled(s, &mut rng))).collect();
        statistic(&medians)
    };
    let draws: Vec<Vec<f64>> = (0..bootstrap.replicates).map(draw).collect();
    let freedom = samples.iter().map(|s| s.len() - 1).min().unwrap_or(0);
    let column = |index: usize| draws.iter().map(|row| row[index]).collect();
    Ok(values.iter().enumerate().map(|(i, &value)| summary(value, column(i), freedom).score).collect())
}

fn resampled(sample: &[f64], rng: &mut Rng) -> Vec<f64> {
    let times = rng.multinomial(sample.len());
    sample.iter().zip(times).flat_map(|(&v, n)| std::iter::repeat_n(v, n as usize)).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let (low, high) = (values[(values.len() - 1) / 2], values[values.len() / 2]);
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_of_medians_has_an_interval_that_ignores_a_straggler() {
        let a: Vec<f64> = (0..61).map(|i| 2.0 + 0.001 * f64::from(i % 7)).chain([9.0]).collect();
        let b: Vec<f64> = (0..61).map(|i| 1.0 + 0.001 * f64::from(i % 5)).collect();
        let score =
            compare_medians(&[&a, &b], |m| vec![m[0] / m[1]], &Bootstrap::default()).expect("made")[0];
        assert!((score.value - 2.003 / 1.002).abs() < 1e-12);
        assert!(score.low > 1.99 && score.high < 2.01, "{score:?}");
        assert!(compare_medians(&[&a, &[]], <[f64]>::to_vec, &Bootstrap::default()).is_err());
    }
}
