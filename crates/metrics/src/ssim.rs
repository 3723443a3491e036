//! Structural similarity of two shadow masks.
//!
//! Source: Wang, Bovik, Sheikh, Simoncelli, *Image Quality Assessment: From Error Visibility to
//! Structural Similarity*, IEEE TIP 13(4), 2004: 11x11 Gaussian window of sigma 1.5, K1 0.01, K2 0.03,
//! population covariance, data range 1. Range: -1 to 1. Direction: 1 is perfect. Blind spot: flat
//! regions score 1 and dilute it; noise in dark flat regions is overrated.

use crate::flip::{PictureScore, same_size, scored};
use crate::{Bootstrap, MetricsError};
use rayon::prelude::*;
use umbrage_frame::{Image, ShadowMask};

const RADIUS: usize = 5;
const WINDOW: usize = 2 * RADIUS + 1;
const SIGMA: f64 = 1.5;
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// SSIM of a mask against the truth. The map holds the places where the whole window fits: it is 10
/// pixels smaller each way.
///
/// # Errors
/// Masks of different sizes or smaller than the window, values that are not finite.
pub fn ssim(
    truth: &ShadowMask,
    test: &ShadowMask,
    bootstrap: &Bootstrap,
) -> Result<PictureScore, MetricsError> {
    same_size(truth, test)?;
    let (width, height) = (truth.width(), truth.height());
    if (width as usize) < WINDOW || (height as usize) < WINDOW {
        return Err(MetricsError::TooSmall { width, height });
    }
    for (what, mask) in [("the truth", truth), ("the variant", test)] {
        if let Some(point) = mask.pixels().iter().position(|v| !v.is_finite()) {
            return Err(MetricsError::NotFinite { what, frame: 0, seed: 0, point });
        }
    }
    let moments = blurred_moments(truth, test);
    let map = moments.iter().map(|m| similarity(m) as f32).collect();
    let inner = 2 * RADIUS as u32;
    Ok(scored(Image::from_pixels(width - inner, height - inner, map), bootstrap))
}

/// Window means of a, b, a^2, b^2, ab.
type Moments = [f64; 5];

fn similarity([a, b, aa, bb, ab]: &Moments) -> f64 {
    let (var_a, var_b, covariance) = (aa - a * a, bb - b * b, ab - a * b);
    let luminance = (2.0 * a * b + C1) / (a * a + b * b + C1);
    luminance * (2.0 * covariance + C2) / (var_a + var_b + C2)
}

/// The five means at every place where the window fits: along x, then along y.
fn blurred_moments(truth: &ShadowMask, test: &ShadowMask) -> Vec<Moments> {
    let (width, height) = (truth.width() as usize, truth.height() as usize);
    let kernel = gaussian();
    let inner = width + 1 - WINDOW;
    let row = |y: usize| -> Vec<Moments> {
        let line = |mask: &ShadowMask| -> Vec<f64> {
            mask.pixels()[y * width..(y + 1) * width].iter().map(|&v| f64::from(v)).collect()
        };
        let (a, b) = (line(truth), line(test));
        let products: Vec<Moments> = a.iter().zip(&b).map(|(&a, &b)| [a, b, a * a, b * b, a * b]).collect();
        (0..inner).map(|x| weighted(&kernel, |k| products[x + k])).collect()
    };
    let rows: Vec<Vec<Moments>> = (0..height).into_par_iter().map(row).collect();
    let column = |y: usize| (0..inner).map(|x| weighted(&kernel, |k| rows[y + k][x])).collect::<Vec<_>>();
    (0..height + 1 - WINDOW).into_par_iter().flat_map_iter(column).collect()
}

fn weighted(kernel: &[f64; WINDOW], at: impl Fn(usize) -> Moments) -> Moments {
    let mut sum = [0.0; 5];
    for (k, weight) in kernel.iter().enumerate() {
        sum.iter_mut().zip(at(k)).for_each(|(s, v)| *s += weight * v);
    }
    sum
}

fn gaussian() -> [f64; WINDOW] {
    let weight = |k: usize| (-0.5 * ((k as f64 - RADIUS as f64) / SIGMA).powi(2)).exp();
    let sum: f64 = (0..WINDOW).map(weight).sum();
    std::array::from_fn(|k| weight(k) / sum)
}
