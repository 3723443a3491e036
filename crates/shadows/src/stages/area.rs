//! Means of moments over a square: where they come from and how a shader reads them.

use super::moments::{Content, Levels, moments};
use super::summed_area::{Fixed, summed_area};
use super::{Shade, moments_filtered};
use crate::recording::{Binding, Recording};
use crate::shader;
use crate::{Calibration, Inputs};

/// Where moments over a square come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Area {
    /// The map's texels, interpolated.
    Texel,
    /// A map that holds its own filter: 4 x 4 texels, then 3 x 3 of those.
    Filtered,
    /// A trilinear tap of a mip chain.
    Mips,
    /// Four corners of a summed-area table.
    Table,
}

/// Least variance in squares of the far plane's distance. As printed: the third document's constant
/// has no value; the square of the fourth's bias, 0.001, is taken. Light-matched: what f32 moments
/// round by (2^-24 of squares up to 1/4), beyond which the bias keeps planes lit.
fn min_variance(calibration: Calibration) -> f64 {
    match calibration {
        Calibration::AsPrinted => 1e-6,
        Calibration::LightMatched => 1e-8,
    }
}

impl Area {
    /// In words.
    pub(crate) fn describe(self) -> &'static str {
        match self {
            Self::Texel => "the map's texels, interpolated bilinearly",
            Self::Filtered => "means of 4x4 texels, then of 3x3 of those",
            Self::Mips => "mip chain, trilinear",
            Self::Table => "summed-area table",
        }
    }

    /// Lookups.
    pub(crate) fn taps(self) -> u32 {
        match self {
            Self::Texel | Self::Filtered => 4,
            Self::Mips => 8,
            Self::Table => 16,
        }
    }

    /// What a kernel cannot exceed, in words.
    pub(crate) fn cut(self) -> &'static str {
        if self == Self::Table { ", and 128 texels wide" } else { "" }
    }

    /// Adds the passes that make the moments, and to a last pass what reads them: the slot
    /// `moments_over` and the bound.
    pub(crate) fn read_by(self, shade: Shade, recording: &mut Recording, inputs: &Inputs<'_>) -> Shade {
        let mut floor = min_variance(inputs.calibration);
        let (texture, slot, mut constants) = match self {
            Self::Table => {
                let fixed = Fixed::new(inputs.calibration, inputs.light);
                floor = floor.max(fixed.variance(inputs.light));
                (summed_area(recording, inputs, fixed), shader::MOMENTS_TABLE, fixed.constants())
            }
            Self::Filtered => (moments_filtered(recording, inputs), shader::MOMENTS_MIPS, step(4.0)),
            Self::Texel => {
                let texels = moments(recording, inputs, (Content::Variance, Levels::Finest));
                (texels, shader::MOMENTS_MIPS, step(1.0))
            }
            Self::Mips => {
                let chain = moments(recording, inputs, (Content::Variance, Levels::All));
                (chain, shader::MOMENTS_MIPS, step(1.0))
            }
        };
        constants.push(("MIN_VARIANCE", floor));
        let (mut all, mut uses, mut reads) = (shade.constants, shade.uses, shade.reads);
        all.extend(constants);
        uses.extend([slot, shader::MOMENT_DEPTH]);
        reads.push(Binding::Source(texture));
        Shade { constants: all, uses, reads, ..shade }
    }
}

/// Texels of the map per texel of the finest level.
fn step(texels: f64) -> Vec<(&'static str, f64)> {
    vec![("MOMENTS_STEP", texels)]
}
