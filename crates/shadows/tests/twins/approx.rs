//! Numbers with a bound on how far an f32 evaluation of the same formula may be from them (running
//! error analysis: Higham, "Accuracy and Stability of Numerical Algorithms", 2002, section 3.3).
//!
//! Every tolerance of the comparisons follows from these bounds. Roundings are those that WGSL
//! allows: half an ulp for sums and products, 2.5 ulp for quotients, 4.5 for roots.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Half an ulp of f32, relative.
pub(crate) const U: f64 = 1.0 / (1u64 << 24) as f64;

/// Absolute error of sine and cosine: an assumption that goes beyond the standard. WGSL promises
/// 2^-11 within one turn and nothing outside of it; drivers evaluate polynomials of about 2^-22 after
/// a reduction that loses up to an ulp of the angle. A driver that only keeps the promise may fail
/// here and be right.
///
/// It admits taps that are off by a millionth of the kernel's radius. It catches, in `vogels_disc`,
/// a golden angle that is wrong in its sixth digit. With 2^-11 in its place that test would ask too
/// much (its limit of 4e-5 would have to be 5e-4: the fifth digit), the comparisons of variants keep
/// within their open shares, and every planted error (2.5 for 2.4, sine for cosine, half a texel)
/// is still noticed: tried once with lavapipe.
const SINE: f64 = 1.0 / (1u64 << 20) as f64;

/// The error of what may be anything (finite, so that its products are numbers).
pub(crate) const UNKNOWN: f64 = 1e9;

/// A value, and a bound on the distance of its f32 evaluation from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Approx {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

impl Approx {
    /// A value that f32 holds.
    pub(crate) const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A constant, rounded to f32.
    pub(crate) fn constant(value: f64) -> Self {
        Self { value, error: (value - f64::from(value as f32)).abs() }
    }

    /// The result of one or two of the CPU library's functions, each within an ulp or two.
    pub(crate) fn library(value: f64) -> Self {
        Self { value, error: 8.0 * U * value.abs() }
    }

    fn operation(value: f64, propagated: f64, half_ulps: f64) -> Self {
        Self { value, error: propagated + half_ulps * U * (value.abs() + propagated) }
    }

    /// A root in WGSL; on a CPU it is rounded once.
    pub(crate) fn sqrt(self) -> Self {
        self.root(9.0)
    }

    fn root(self, half_ulps: f64) -> Self {
        let root = self.value.max(0.0).sqrt();
        // The root's slope is unbounded at 0, its change is not.
        let steepest = if root > 0.0 { self.error / root } else { f64::INFINITY };
        Self::operation(root, steepest.min(self.error.sqrt()), half_ulps)
    }

    fn over(self, other: Self, half_ulps: f64) -> Self {
        let quotient = self.value / other.value;
        let smallest = other.value.abs() - other.error;
        let propagated = (self.error + quotient.abs() * other.error) / smallest;
        Self::operation(quotient, if smallest > 0.0 { propagated } else { UNKNOWN }, half_ulps)
    }

    pub(crate) fn cos(self) -> Self {
        Self { value: self.value.cos(), error: (self.error + SINE + 2.0 * U * self.value.abs()).min(2.0) }
    }

    pub(crate) fn sin(self) -> Self {
        Self { value: self.value.sin(), error: (self.error + SINE + 2.0 * U * self.value.abs()).min(2.0) }
    }

    /// The part of it after the point; its error is meant round a circle of length 1.
    pub(crate) fn fract(self) -> Self {
        Self { value: self.value - self.value.floor(), error: self.error + U }
    }

    pub(crate) fn max(self, other: Self) -> Self {
        let (low, high) = (self.low().max(other.low()), self.high().max(other.high()));
        let value = self.value.max(other.value);
        Self { value, error: (value - low).max(high - value) }
    }

    pub(crate) fn min(self, other: Self) -> Self {
        -(-self).max(-other)
    }

    pub(crate) fn low(self) -> f64 {
        self.value - self.error
    }

    pub(crate) fn high(self) -> f64 {
        self.value + self.error
    }

    /// Whether an f32 result may be this number.
    pub(crate) fn admits(self, result: f32) -> bool {
        (f64::from(result) - self.value).abs() <= self.error
    }

    /// What the floor of the f32 result may be.
    pub(crate) fn floors(self) -> std::ops::RangeInclusive<i64> {
        self.low().floor() as i64..=self.high().floor() as i64
    }
}

impl From<f32> for Approx {
    fn from(value: f32) -> Self {
        Self::exact(value.into())
    }
}

impl Add for Approx {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::operation(self.value + other.value, self.error + other.error, 1.0)
    }
}

impl Sub for Approx {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Approx {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, error: self.error }
    }
}

impl Mul for Approx {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.value.abs(), other.value.abs());
        let propagated = a * other.error + b * self.error + self.error * other.error;
        Self::operation(self.value * other.value, propagated, 1.0)
    }
}

impl Div for Approx {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.over(other, 5.0)
    }
}

/// Their sum, in whatever order (and with fused products) a compiler chooses.
pub(crate) fn sum(terms: &[Approx]) -> Approx {
    let magnitude: f64 = terms.iter().map(|t| t.value.abs() + t.error).sum();
    let propagated: f64 = terms.iter().map(|t| t.error).sum();
    let roundings = terms.len() as f64 - 1.0;
    Approx { value: terms.iter().map(|t| t.value).sum(), error: propagated + roundings * U * magnitude }
}

/// Three of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Approx3(pub(crate) [Approx; 3]);

impl Approx3 {
    pub(crate) fn from_vec(v: glam::Vec3) -> Self {
        Self(v.to_array().map(Approx::from))
    }

    fn zip(self, other: Self, f: impl Fn(Approx, Approx) -> Approx) -> Self {
        Self(std::array::from_fn(|k| f(self.0[k], other.0[k])))
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    pub(crate) fn minus(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    pub(crate) fn times(self, factor: Approx) -> Self {
        Self(self.0.map(|c| c * factor))
    }

    pub(crate) fn dot(self, other: Self) -> Approx {
        let Self(products) = self.zip(other, |a, b| a * b);
        sum(&products)
    }

    pub(crate) fn cross(self, other: Self) -> Self {
        let (a, b) = (self.0, other.0);
        Self([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])
    }

    pub(crate) fn length(self) -> Approx {
        self.dot(self).sqrt()
    }

    pub(crate) fn normalized(self) -> Self {
        let length = self.length();
        Self(self.0.map(|c| c / length))
    }

    /// On a CPU, by its reciprocal length: every operation is rounded once.
    pub(crate) fn normalized_on_cpu(self) -> Self {
        let reciprocal = Approx::exact(1.0).over(self.dot(self).root(1.0), 1.0);
        self.times(reciprocal)
    }
}
