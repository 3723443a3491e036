//! Planes of floats as small pictures: quantised, coloured, compressed.

mod colour;
mod png;

pub(crate) use colour::{HATCH, Ramp};

use crate::ReportError;
use umbrage_frame::Image;

/// How a plane is turned into colours: a ramp from `low` to `high`; what lies beyond is clamped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    pub(crate) ramp: Ramp,
    pub(crate) low: f32,
    pub(crate) high: f32,
}

impl Scale {
    /// Shadows: grey level proportional to visibility.
    pub(crate) const SHADOW: Self = Self { ramp: Ramp::Grey, low: 0.0, high: 1.0 };

    /// Signed errors, white at 0.
    pub(crate) fn error(limit: f32) -> Self {
        Self { ramp: Ramp::Signed, low: -limit, high: limit }
    }

    /// Magnitudes from 0.
    pub(crate) fn magnitude(limit: f32) -> Self {
        Self { ramp: Ramp::Magnitude, low: 0.0, high: limit }
    }

    /// The palette's index of a value; NaN becomes a hatch that depends on the place.
    fn index(self, value: f32, x: u32, y: u32) -> u8 {
        let steps = self.ramp.levels() - 1;
        if value.is_nan() {
            // Diagonal stripes, four pixels wide: no ramp has them.
            return steps + 1 + u8::from((x + y) % 8 < 4);
        }
        let t = (value - self.low) / (self.high - self.low);
        (t.clamp(0.0, 1.0) * f32::from(steps)).round() as u8
    }
}

/// A plane as a PNG with a palette.
pub(crate) fn png_of(name: &str, plane: &Image<f32>, scale: Scale) -> Result<Vec<u8>, ReportError> {
    let indices = Image::from_fn(plane.width(), plane.height(), |x, y| scale.index(*plane.at(x, y), x, y));
    png::indexed(&indices, &scale.ramp.palette()).map_err(|reason| picture_error(name, reason))
}

/// Display-linear RGB (1 = white) as a PNG, with the sRGB transfer curve.
pub(crate) fn png_of_beauty(name: &str, beauty: &Image<[f32; 3]>) -> Result<Vec<u8>, ReportError> {
    png::rgb(&beauty.map(|rgb| colour::display(*rgb))).map_err(|reason| picture_error(name, reason))
}

/// The colour of a visibility at a pixel; NaN is hatched.
pub(crate) fn shade(value: f32, x: u32, y: u32) -> [u8; 3] {
    if value.is_nan() {
        return HATCH[usize::from((x + y) % 8 < 4)];
    }
    [(255.0 * value.clamp(0.0, 1.0)).round() as u8; 3]
}

/// Colours as a PNG.
pub(crate) fn png_of_rgb(name: &str, picture: &Image<[u8; 3]>) -> Result<Vec<u8>, ReportError> {
    png::rgb(picture).map_err(|reason| picture_error(name, reason))
}

/// A ramp from its low end (left) to its high end, for colour bars.
pub(crate) fn png_of_bar(ramp: Ramp) -> Result<Vec<u8>, ReportError> {
    let levels = ramp.levels();
    let bar = Image::from_fn(u32::from(levels), 1, |x, _| x as u8);
    png::indexed(&bar, &ramp.palette()).map_err(|reason| picture_error("bar", reason))
}

fn picture_error(name: &str, reason: String) -> ReportError {
    ReportError::Picture { name: name.into(), reason }
}

/// The smallest of 1, 2, 5 times a power of ten that is not below `value`; 1 when nothing is there.
pub(crate) fn round_up(value: f32) -> f32 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = 10f64.powf(f64::from(value).log10().floor());
    // The last bits of the logarithm must not push 0.2 up to 0.5.
    let fits = |m: &f64| f64::from(value) <= m * decade * (1.0 + 1e-6);
    ([1.0, 2.0, 5.0].into_iter().find(fits).unwrap_or(10.0) * decade) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_zero_is_white_and_sides_are_blue_and_red() {
        let scale = Scale::error(0.2);
        let palette = Ramp::Signed.palette();
        assert_eq!(palette[usize::from(scale.index(0.0, 0, 0))], [255, 255, 255]);
        let [red, _, blue] = palette[usize::from(scale.index(-0.2, 0, 0))];
        assert!(blue > red, "too dark is blue");
        let [red, _, blue] = palette[usize::from(scale.index(9.0, 0, 0))];
        assert!(red > blue, "too light is red, and what lies beyond the scale is clamped");
    }

    #[test]
    fn what_does_not_count_is_hatched_in_colours_of_no_ramp() {
        for scale in [Scale::SHADOW, Scale::error(0.2), Scale::magnitude(0.1)] {
            let ramp = scale.ramp;
            let stripes = [scale.index(f32::NAN, 0, 0), scale.index(f32::NAN, 4, 0)];
            assert_eq!(stripes.map(|i| ramp.palette()[usize::from(i)]), [HATCH[1], HATCH[0]]);
            let ramp_colours = &ramp.palette()[..usize::from(ramp.levels())];
            assert!(ramp_colours.iter().all(|c| !HATCH.contains(c)));
        }
    }

    #[test]
    fn limits_are_round() {
        assert_eq!([0.2, 0.21, 0.0, 0.0011, 1.0].map(round_up), [0.2, 0.5, 1.0, 0.002, 1.0]);
        assert_eq!([f32::NAN, 7.3].map(round_up), [1.0, 10.0]);
    }
}
