//! Colour ramps, built in OKLab (B. Ottosson, "A perceptual color space for image processing",
//! 2020), so that equal steps of a value are about equal steps to the eye.

/// The two colours of the hatch over what is not counted: greenish, which no ramp is.
pub(crate) const HATCH: [[u8; 3]; 2] = [[172, 186, 177], [158, 173, 164]];

/// A way from numbers to colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ramp {
    /// Black to white, the 8-bit level proportional to the number.
    Grey,
    /// Blue, white in the middle, red; equally light on both sides.
    Signed,
    /// Near black through purple and orange to pale yellow, lightness linear.
    Magnitude,
}

impl Ramp {
    /// Number of colours; odd, so that a signed ramp has a middle. Errors and magnitudes are read
    /// against a bar, where 127 steps are more than an eye tells apart, and compress better.
    pub(crate) fn levels(self) -> u8 {
        match self {
            Self::Grey => 253,
            Self::Signed | Self::Magnitude => 127,
        }
    }

    /// The colours from low to high, then the two of the hatch.
    pub(crate) fn palette(self) -> Vec<[u8; 3]> {
        let last = f64::from(self.levels() - 1);
        let colours = (0..self.levels()).map(|i| self.at(f64::from(i) / last));
        colours.chain(HATCH).collect()
    }

    /// The colour at `t`, 0 to 1.
    fn at(self, t: f64) -> [u8; 3] {
        match self {
            Self::Grey => [(255.0 * t).round() as u8; 3],
            Self::Signed => {
                let signed = 2.0 * t - 1.0;
                let (size, hue) = (signed.abs(), if signed < 0.0 { 258.0 } else { 27.0 });
                // Chroma rises faster than lightness falls: small errors get a tint, not a shade.
                in_gamut(Lch { l: 1.0 - 0.62 * size, c: 0.21 * size.powf(0.8), hue })
            }
            Self::Magnitude => {
                let chroma = 0.19 * (std::f64::consts::PI * (0.08 + 0.84 * t)).sin().powf(0.7);
                in_gamut(Lch { l: 0.14 + 0.83 * t, c: chroma, hue: 285.0 + 180.0 * t })
            }
        }
    }
}

/// Lightness 0 to 1, chroma, hue in degrees.
#[derive(Clone, Copy)]
struct Lch {
    l: f64,
    c: f64,
    hue: f64,
}

/// The sRGB colour of the same lightness and hue, with as much of the chroma as the screen can show.
fn in_gamut(wanted: Lch) -> [u8; 3] {
    let shown = |c: f64| linear_srgb(Lch { c, ..wanted }).iter().all(|v| (-1e-9..=1.0 + 1e-9).contains(v));
    let (mut inside, mut outside) = (0.0, wanted.c);
    if shown(wanted.c) {
        inside = wanted.c;
    }
    // 20 halvings leave a millionth of the chroma, far below an 8-bit step.
    for _ in 0..20 {
        let middle = 0.5 * (inside + outside);
        if shown(middle) { inside = middle } else { outside = middle }
    }
    linear_srgb(Lch { c: inside, ..wanted }).map(|v| encode(v as f32))
}

/// OKLab to linear sRGB, with the matrices of the publication.
fn linear_srgb(Lch { l, c, hue }: Lch) -> [f64; 3] {
    let (a, b) = (c * hue.to_radians().cos(), c * hue.to_radians().sin());
    let long = (l + 0.396_337_777_4 * a + 0.215_803_757_3 * b).powi(3);
    let medium = (l - 0.105_561_345_8 * a - 0.063_854_172_8 * b).powi(3);
    let short = (l - 0.089_484_177_5 * a - 1.291_485_548_0 * b).powi(3);
    [
        4.076_741_662_1 * long - 3.307_711_591_3 * medium + 0.230_969_929_2 * short,
        -1.268_438_004_6 * long + 2.609_757_401_1 * medium - 0.341_319_396_5 * short,
        -0.004_196_086_3 * long - 0.703_418_614_7 * medium + 1.707_614_701_0 * short,
    ]
}

/// Linear RGB to display bytes, with the sRGB transfer curve; NaN becomes black.
pub(crate) fn display(rgb: [f32; 3]) -> [u8; 3] {
    rgb.map(encode)
}

fn encode(linear: f32) -> u8 {
    let v = linear.clamp(0.0, 1.0);
    let curve = if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
    (255.0 * curve).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CIE lightness rises with luminance: comparing luminance compares lightness.
    fn luminance(colour: [u8; 3]) -> f64 {
        let linear = colour.map(|c| {
            let v = f64::from(c) / 255.0;
            if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
        });
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    }

    #[test]
    fn magnitudes_grow_lighter_at_every_step() {
        let palette = Ramp::Magnitude.palette();
        let light: Vec<f64> = palette[..127].iter().map(|&c| luminance(c)).collect();
        assert!(light.windows(2).all(|w| w[0] < w[1]));
    }

    #[test]
    fn both_signs_darken_alike() {
        let palette = Ramp::Signed.palette();
        for step in 0..=63 {
            let [blue, red] = [palette[63 - step], palette[63 + step]].map(|c| luminance(c).cbrt());
            // OKLab's lightness weighs hues otherwise than CIE's: up to 6 hundredths apart here. An
            // unbalanced pair (pure blue against pure red) is 2 tenths apart.
            assert!((blue - red).abs() < 0.06, "step {step}: {blue} {red}");
        }
    }

    #[test]
    fn grey_is_proportional() {
        let palette = Ramp::Grey.palette();
        assert_eq!([palette[0], palette[126], palette[252]], [[0; 3], [128; 3], [255; 3]]);
    }
}
