//! FLIP on shaded pictures.
//!
//! Source: Andersson et al., *FLIP: A Difference Evaluator for Alternating Images* (HPG 2020), through
//! flip-rs. Range: 0 to 1. Direction: lower is better. Blind spot: one frame, no time; depends on
//! exposure and viewing distance, which are therefore always stated (the automatic exposure fails on
//! pictures whose median is black, common in shadow).

use crate::bootstrap::Stratum;
use crate::error::expect_length;
use crate::{Bootstrap, MetricsError, Score, TILE_PX};
use glam::Vec3;
use umbrage_frame::Image;

/// How a picture is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewing {
    /// Pixels per degree of visual angle.
    pub pixels_per_degree: f32,
    /// Linear radiance is multiplied by 2 to this power and clipped at 1.
    pub exposure_stops: f32,
}

impl Default for Viewing {
    /// A 0.7 m wide monitor of 3840 pixels seen from 0.7 m; radiance 1 is white.
    fn default() -> Self {
        Self { pixels_per_degree: flip_rs::DEFAULT_PPD, exposure_stops: 0.0 }
    }
}

/// A metric of a whole picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureScore {
    /// Mean of the map, with an interval over tiles.
    pub mean: Score,
    /// Value per pixel.
    pub map: Image<f32>,
}

/// LDR-FLIP of two pictures in linear RGB.
///
/// # Errors
/// Pictures of different sizes or without pixels, values that are not finite, a number of pixels
/// per degree that is not positive.
pub fn flip(
    truth: &Image<Vec3>,
    test: &Image<Vec3>,
    viewing: Viewing,
    bootstrap: &Bootstrap,
) -> Result<PictureScore, MetricsError> {
    same_size(truth, test)?;
    let (reference, shown) = (encoded(truth, viewing)?, encoded(test, viewing)?);
    let map = flip_rs::ldr_flip(&reference, &shown, viewing.pixels_per_degree).map_err(refused)?;
    Ok(scored(Image::from_pixels(truth.width(), truth.height(), map.into_pixels()), bootstrap))
}

fn encoded(image: &Image<Vec3>, viewing: Viewing) -> Result<flip_rs::RgbImage<f32>, MetricsError> {
    let gain = viewing.exposure_stops.exp2();
    let channels = image.pixels().iter().flat_map(|p| p.to_array()).map(|c| srgb(gain * c)).collect();
    flip_rs::RgbImage::new(image.width() as usize, image.height() as usize, channels).map_err(refused)
}

/// The sRGB transfer function (IEC 61966-2-1), input clipped to 0..1; NaN stays NaN.
fn srgb(linear: f32) -> f32 {
    let c = linear.clamp(0.0, 1.0);
    if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

fn refused(error: flip_rs::FlipError) -> MetricsError {
    MetricsError::Flip(error.to_string())
}

/// The mean of a map with its interval over tiles.
pub(crate) fn scored(map: Image<f32>, bootstrap: &Bootstrap) -> PictureScore {
    let (columns, rows) = (map.width().div_ceil(TILE_PX), map.height().div_ceil(TILE_PX));
    let mut sums = vec![vec![0.0; 2]; columns as usize * rows as usize];
    for (index, &value) in map.pixels().iter().enumerate() {
        let (x, y) = (index as u32 % map.width(), index as u32 / map.width());
        let tile = &mut sums[(y / TILE_PX * columns + x / TILE_PX) as usize];
        (tile[0], tile[1]) = (tile[0] + 1.0, tile[1] + f64::from(value));
    }
    let tiles = sums.into_iter().enumerate().map(|(i, s)| (i as u32 % columns, i as u32 / columns, s));
    let stratum = Stratum::new(2, tiles, bootstrap.cluster_tiles);
    let mean = bootstrap.estimate(&[stratum], |sums| vec![sums[0][1] / sums[0][0]])[0].score;
    PictureScore { mean, map }
}

/// That two pictures are of one size.
pub(crate) fn same_size<T, U>(a: &Image<T>, b: &Image<U>) -> Result<(), MetricsError> {
    expect_length("pixels per row", a.width() as usize, b.width() as usize)?;
    expect_length("rows of pixels", a.height() as usize, b.height() as usize)
}
