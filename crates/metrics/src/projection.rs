//! The fixed orthogonal projection that splits an error into smooth and structured.
//!
//! Per tile, P projects on the span of {1, g, g^2, g^3} x {1, x, y}, with g a third estimate of the
//! truth (METRICS: a basis from the halves moves reference noise between rows). It is linear,
//! symmetric and the same for all frames and seeds, so `|e|^2 = |Pe|^2 + |(1-P)e|^2`; a band-pass
//! filter is not, and is deliberately absent.

/// An orthonormal basis over the points of one tile.
#[derive(Clone, Debug, PartialEq)]
pub struct Projection {
    points: usize,
    /// `functions` rows of `points` numbers.
    basis: Vec<f64>,
}

/// At least so many points for each function, or fewer functions.
const POINTS_PER_FUNCTION: usize = 3;

/// A function is dropped when what the earlier ones leave of it is shorter than this share of it.
/// Admits: f32 truths (6e-8) times the condition of a cubic on [-1, 1] (about 10). Catches: g
/// constant over a tile, points on one line.
const DEPENDENT: f64 = 1e-6;

impl Projection {
    /// From the truth's visibility and the pixel coordinates of each point.
    ///
    /// The functions of g come first: with few points, a wrong penumbra width stays smooth. One
    /// function, the constant, is always there.
    pub fn new(g: &[f64], px: &[[f64; 2]]) -> Self {
        let points = g.len();
        let wanted = (points / POINTS_PER_FUNCTION).clamp(1, 12);
        let mut projection = Self { points, basis: Vec::new() };
        if points == 0 {
            return projection;
        }
        let [x, y] = [0, 1].map(|axis| centred(px.iter().map(|p| p[axis])));
        let one = vec![1.0; points];
        let powers = |power: i32| -> Vec<f64> { g.iter().map(|&g| (2.0 * g - 1.0).powi(power)).collect() };
        for power in 0..4 {
            projection.add(product(&powers(power), &one), wanted);
        }
        for power in 0..4 {
            projection.add(product(&powers(power), &x), wanted);
            projection.add(product(&powers(power), &y), wanted);
        }
        projection
    }

    /// Orthonormalises a function against the ones before and keeps it, unless it is dependent on
    /// them or `wanted` are there.
    fn add(&mut self, mut function: Vec<f64>, wanted: usize) {
        let before = dot(&function, &function).sqrt();
        // Twice: once leaves errors of the size of DEPENDENT^-1 roundings ("twice is enough", Kahan).
        for _ in 0..2 {
            for row in self.basis.chunks_exact(self.points) {
                let overlap = dot(row, &function);
                function.iter_mut().zip(row).for_each(|(f, r)| *f -= overlap * r);
            }
        }
        let length = dot(&function, &function).sqrt();
        if self.functions() < wanted && length > DEPENDENT * before {
            self.basis.extend(function.iter().map(|f| f / length));
        }
    }

    /// Dimension of the smooth space. Over the number of points, it is the share of white error
    /// that counts as smooth.
    pub fn functions(&self) -> usize {
        self.basis.len().checked_div(self.points).unwrap_or(0)
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.points
    }

    /// Coordinates of a field in the basis; their squares sum to `|P field|^2`.
    pub fn coefficients(&self, field: &[f64]) -> Vec<f64> {
        self.basis.chunks_exact(self.points.max(1)).map(|row| dot(row, field)).collect()
    }

    /// The smooth part of a field.
    pub fn smooth(&self, field: &[f64]) -> Vec<f64> {
        let mut smooth = vec![0.0; self.points];
        for row in self.basis.chunks_exact(self.points.max(1)) {
            let coefficient = dot(row, field);
            smooth.iter_mut().zip(row).for_each(|(s, r)| *s += coefficient * r);
        }
        smooth
    }

    /// Projects `columns` fields at once: `fields` holds a row of `columns` numbers per point, the
    /// result a row per function.
    pub(crate) fn project(&self, fields: &[f64], columns: usize) -> Vec<f64> {
        let mut out = vec![0.0; self.functions() * columns];
        for (function, out) in out.chunks_exact_mut(columns.max(1)).enumerate() {
            let row = &self.basis[function * self.points..(function + 1) * self.points];
            for (weight, field) in row.iter().zip(fields.chunks_exact(columns)) {
                out.iter_mut().zip(field).for_each(|(o, f)| *o += weight * f);
            }
        }
        out
    }

    /// The smooth fields with these coefficients: the inverse of [`Projection::project`], a row of
    /// `columns` numbers per point.
    pub(crate) fn fields(&self, coefficients: &[f64], columns: usize) -> Vec<f64> {
        let mut out = vec![0.0; self.points * columns];
        let functions = self.basis.chunks_exact(self.points.max(1));
        for (row, coefficients) in functions.zip(coefficients.chunks_exact(columns.max(1))) {
            for (weight, out) in row.iter().zip(out.chunks_exact_mut(columns)) {
                out.iter_mut().zip(coefficients).for_each(|(o, c)| *o += weight * c);
            }
        }
        out
    }
}

/// Coordinates moved and scaled to -1..1, so that the functions are of one size.
fn centred(coordinates: impl Iterator<Item = f64> + Clone) -> Vec<f64> {
    let (low, high) =
        coordinates.clone().fold((f64::MAX, f64::MIN), |(low, high), c| (low.min(c), high.max(c)));
    let half = (0.5 * (high - low)).max(0.5);
    coordinates.map(|c| (c - 0.5 * (low + high)) / half).collect()
}

fn product(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a * b).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(width: usize, height: usize) -> (Vec<f64>, Vec<[f64; 2]>) {
        let px: Vec<[f64; 2]> =
            (0..width * height).map(|i| [(i % width) as f64, (i / width) as f64]).collect();
        (px.iter().map(|p| (p[0] + 0.5) / width as f64).collect(), px)
    }

    #[test]
    fn a_field_of_the_span_is_its_own_projection() {
        let (g, px) = ramp(32, 32);
        // g is linear in x here, so of 12 functions only 1..x^4 times 1 and 1..x^3 times y remain.
        let projection = Projection::new(&g, &px);
        assert_eq!(projection.functions(), 9);
        let field: Vec<f64> = g.iter().zip(&px).map(|(g, p)| 0.3 - g * g * g + 0.1 * g * p[1]).collect();
        let smooth = projection.smooth(&field);
        // 32*32 products of numbers below 4, twice: 1e3 roundings of 1e-16.
        assert!(field.iter().zip(&smooth).all(|(f, s)| (f - s).abs() < 1e-12));
    }

    #[test]
    fn parts_are_orthogonal_and_few_points_get_few_functions() {
        for (width, height, functions) in [(1, 1, 1), (2, 1, 1), (3, 3, 3), (4, 4, 5)] {
            let (g, px) = ramp(width, height);
            assert_eq!(Projection::new(&g, &px).functions(), functions, "{width}x{height}");
        }
        let (g, px) = ramp(17, 9);
        let projection = Projection::new(&g, &px);
        let field: Vec<f64> = (0..g.len()).map(|i| ((i * 37 % 101) as f64 / 101.0) - 0.5).collect();
        let smooth = projection.smooth(&field);
        let rest: Vec<f64> = field.iter().zip(&smooth).map(|(f, s)| f - s).collect();
        assert!(dot(&smooth, &rest).abs() < 1e-13 * dot(&field, &field));
        let coefficients = projection.coefficients(&field);
        assert!((dot(&coefficients, &coefficients) - dot(&smooth, &smooth)).abs() < 1e-12);
    }

    #[test]
    fn a_flat_truth_leaves_the_functions_of_place() {
        let (_, px) = ramp(8, 8);
        assert_eq!(Projection::new(&[0.25; 64], &px).functions(), 3);
    }
}
