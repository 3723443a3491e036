//! The curve shared by keyframe paths and glTF's cubic splines.

use std::ops::{Add, Mul};

/// The cubic with these values and slopes at 0 and 1, in Hermite's form: from, its slope, to, its
/// slope.
pub(crate) fn hermite<T>([from, from_slope, to, to_slope]: [T; 4], t: f64) -> T
where
    T: Add<Output = T> + Mul<f64, Output = T>,
{
    let (t2, t3) = (t * t, t * t * t);
    from * (2.0 * t3 - 3.0 * t2 + 1.0)
        + from_slope * (t3 - 2.0 * t2 + t)
        + to * (3.0 * t2 - 2.0 * t3)
        + to_slope * (t3 - t2)
}

#[cfg(test)]
mod tests {
    use super::hermite;

    /// Hermite's form reproduces any cubic exactly, up to the rounding of a dozen operations.
    #[test]
    fn reproduces_a_cubic() {
        let (value, slope) = (|x: f64| 2.0 * x.powi(3) - x + 1.0, |x: f64| 6.0 * x * x - 1.0);
        for t in [0.0, 0.25, 0.5, 1.0] {
            let curve = hermite([value(0.0), slope(0.0), value(1.0), slope(1.0)], t);
            assert!((curve - value(t)).abs() < 1e-14, "{curve} at {t}");
        }
    }
}
