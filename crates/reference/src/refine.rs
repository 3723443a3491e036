//! More samples where the standard error asks for them.
//!
//! A pilot of few samples estimates each point's variance; what is kept comes from fresh samples, as
//! many as the pilot asked for. Were the pilot's samples kept where they look good enough, points whose
//! replicates agree by chance would be kept too often, and V be biased towards 0 and 1.

use crate::owen::mix;
use crate::truth::MOST_ON_SCANLINES;
use crate::{GroundTruth, Points, TruthSettings};

/// Samples a half of the pilot, at most.
const PILOT: u32 = 128;
/// Most samples a half on Sobol points: what eight replicates of them hold at a bearable cost.
const MOST_ON_POINTS: u32 = 32_768;
/// What the pilot's seed differs by.
const APART: u64 = 0x9170_7000;
/// The standard error falls like the number of samples to this power where one edge crosses the
/// light: measured .75 on scanlines (docs/performance.md), .5 at worst.
const RATE: f64 = 0.75;
/// The pilot's standard error, of eight replicates, is below .6 of the truth in one of ten (chi-square
/// of 7 degrees of freedom: 2.83).
const DOUBT: f64 = 1.0 / 0.6;

/// What the standard errors of a truth came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reached {
    /// The root of the mean variance.
    pub rms: f64,
    /// The largest standard error.
    pub worst: f64,
    /// The part of the points, 0 to 1, whose standard error is above the tolerance.
    pub above: f64,
    /// Samples a point, on average.
    pub samples: f64,
}

impl GroundTruth {
    /// What the standard errors came to, against a tolerance. All 0 without points.
    pub fn reached(&self, tolerance: f32) -> Reached {
        let n = self.variance.len().max(1) as f64;
        let sum: f64 = self.variance.iter().map(|&v| f64::from(v)).sum();
        let worst = self.variance.iter().fold(0.0f32, |m, &v| m.max(v));
        let above = self.variance.iter().filter(|v| v.sqrt() > tolerance).count();
        Reached {
            rms: (sum / n).sqrt(),
            worst: f64::from(worst).sqrt(),
            above: above as f64 / n,
            samples: self.samples.iter().map(|&s| f64::from(s)).sum::<f64>() / n,
        }
    }
}

/// The truth with as many samples as each point needs, from one that finds it with the same number for
/// all.
pub(crate) fn refined<E>(
    points: &Points,
    settings: &TruthSettings,
    tolerance: f32,
    mut equal: impl FnMut(&Points, &TruthSettings) -> Result<GroundTruth, E>,
) -> Result<GroundTruth, E> {
    let most = match settings.method.on_scanlines() {
        true => MOST_ON_SCANLINES,
        // Whoever asks for more gets it everywhere.
        false => MOST_ON_POINTS.max(settings.samples),
    };
    let least = settings.samples.min(most);
    let pilot = TruthSettings {
        samples: least.min(PILOT),
        basis_samples: 0,
        seed: mix(settings.seed ^ APART),
        ..*settings
    };
    let spread = equal(points, &pilot)?;
    let mut groups: Vec<Vec<u32>> = Vec::new();
    for (index, variance) in spread.variance.iter().enumerate() {
        let step = steps(f64::from(*variance).sqrt(), f64::from(tolerance), [pilot.samples, least, most]);
        if groups.len() <= step {
            groups.resize(step + 1, Vec::new());
        }
        groups[step].push(index as u32);
    }
    let mut all = GroundTruth::sized(points.len(), settings.basis_samples > 0);
    for (step, group) in groups.iter().enumerate().filter(|(_, group)| !group.is_empty()) {
        let samples = least.saturating_mul(4u32.saturating_pow(step as u32)).min(most);
        let found = equal(&points.pick(group), &TruthSettings { samples, ..*settings })?;
        all.put(group, &found);
    }
    Ok(all)
}

/// How many times four times as many samples are wanted.
fn steps(error: f64, tolerance: f64, [pilot, least, most]: [u32; 3]) -> usize {
    let wanted = f64::from(pilot) * (DOUBT * error / tolerance.max(f64::MIN_POSITIVE)).powf(1.0 / RATE);
    let mut step = 0;
    let mut samples = f64::from(least);
    while samples < wanted && samples < f64::from(most) {
        samples *= 4.0;
        step += 1;
    }
    step
}

impl Points {
    /// Some that follow each other.
    pub(crate) fn range(&self, range: std::ops::Range<usize>) -> Self {
        Self {
            position: self.position[range.clone()].to_vec(),
            normal: self.normal[range.clone()].to_vec(),
            triangle: self.triangle[range].to_vec(),
        }
    }

    /// Some by their indices.
    pub(crate) fn pick(&self, group: &[u32]) -> Self {
        let at = |i: &u32| *i as usize;
        Self {
            position: group.iter().map(|i| self.position[at(i)]).collect(),
            normal: group.iter().map(|i| self.normal[at(i)]).collect(),
            triangle: group.iter().map(|i| self.triangle[at(i)]).collect(),
        }
    }
}

impl GroundTruth {
    /// Zeros.
    pub(crate) fn sized(points: usize, basis: bool) -> Self {
        let zeros = || vec![0.0; points];
        Self {
            mean: zeros(),
            halves: [zeros(), zeros()],
            basis: if basis { zeros() } else { Vec::new() },
            variance: zeros(),
            samples: vec![0; points],
            facing: vec![false; points],
        }
    }

    /// Some points by their indices.
    pub(crate) fn put(&mut self, group: &[u32], found: &Self) {
        for (i, &at) in group.iter().enumerate() {
            let at = at as usize;
            self.mean[at] = found.mean[i];
            self.halves[0][at] = found.halves[0][i];
            self.halves[1][at] = found.halves[1][i];
            self.variance[at] = found.variance[i];
            self.samples[at] = found.samples[i];
            self.facing[at] = found.facing[i];
            if let (Some(to), Some(from)) = (self.basis.get_mut(at), found.basis.get(i)) {
                *to = *from;
            }
        }
    }
}
