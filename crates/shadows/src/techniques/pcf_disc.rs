//! T5 to T10 and T31: percentage-closer filtering on a disc of one size everywhere, by its points, by
//! how they are turned from pixel to pixel, and by what a tap compares.

use crate::calibration::Law;
use crate::shader::{self, Fragment};
use crate::stages::{Shade, shade};
use crate::{Calibration, Info, Inputs, Kernels, Lights, Projection, Recording, Technique, blue_noise};

const OWN: Fragment = Fragment::new("pcf_disc", include_str!("pcf_disc.wgsl"));

/// The points of a disc.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Points {
    /// Vogel's spiral.
    Vogel,
    /// The second document's table.
    Poisson,
    /// Best-candidate points.
    Blue,
    /// Jimenez's eight.
    Spiral,
}

/// How the disc is turned from pixel to pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rotation {
    /// Not at all.
    Fixed,
    /// By interleaved gradient noise.
    Ign,
    /// By a random number per pixel.
    White,
    /// By a hash of the world position.
    World,
}

/// What a tap compares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tap {
    /// Four texels, bilinearly weighted.
    Bilinear,
    /// The nearest texel.
    Point,
}

/// Percentage-closer filtering on a disc of fixed size.
pub(crate) struct PcfDisc {
    pub(crate) points: Points,
    pub(crate) taps: u32,
    pub(crate) rotation: Rotation,
    pub(crate) tap: Tap,
    pub(crate) projection: Projection,
}

/// The first document's own setting.
pub(crate) const VOGEL_16: PcfDisc = PcfDisc {
    points: Points::Vogel,
    taps: 16,
    rotation: Rotation::Fixed,
    tap: Tap::Bilinear,
    projection: Projection::Single,
};

/// The second document's: its table, its hash, one comparison a tap.
pub(crate) const POISSON_16: PcfDisc =
    PcfDisc { points: Points::Poisson, rotation: Rotation::World, tap: Tap::Point, ..VOGEL_16 };

impl Points {
    fn name(self) -> &'static str {
        match self {
            Self::Vogel => "Vogel disc",
            Self::Poisson => "Poisson disc",
            Self::Blue => "blue-noise disc",
            Self::Spiral => "half-way spiral",
        }
    }

    /// Slot `kernel_tap`.
    pub(crate) fn fragment(self, taps: u32) -> Fragment {
        match self {
            Self::Vogel => shader::KERNEL_VOGEL,
            Self::Poisson => shader::KERNEL_POISSON,
            Self::Blue => blue_noise::kernel_fragment(taps),
            Self::Spiral => shader::KERNEL_SPIRAL,
        }
    }
}

impl Rotation {
    fn name(self) -> &'static str {
        match self {
            Self::Fixed => "the same at every pixel",
            Self::Ign => "turned per pixel by interleaved gradient noise",
            Self::White => "turned per pixel by white noise",
            Self::World => "turned by a hash of the world position",
        }
    }

    /// Slot `pattern`.
    pub(crate) fn fragment(self) -> Fragment {
        match self {
            Self::Fixed => shader::PATTERN_NONE,
            Self::Ign => shader::PATTERN_IGN,
            Self::White => shader::PATTERN_WHITE,
            Self::World => shader::PATTERN_WORLD,
        }
    }
}

impl Tap {
    /// Slot `filter_disc`.
    pub(crate) fn fragment(self) -> Fragment {
        match self {
            Self::Bilinear => shader::FILTER_DISC,
            Self::Point => shader::FILTER_DISC_POINT,
        }
    }

    /// So many of them, in words.
    pub(crate) fn count(self, taps: u32) -> String {
        match self {
            Self::Bilinear => format!("{taps} x 4"),
            Self::Point => taps.to_string(),
        }
    }
}

impl Technique for PcfDisc {
    fn info(&self) -> Info {
        let document = match (self.points, self.rotation, self.tap) {
            _ if self.projection == Projection::Cube => "T6 for a point light: second document, section 1",
            (Points::Vogel, _, Tap::Point) => "T10 without its bilinear compare: first document, section 2.1",
            (Points::Vogel, Rotation::Fixed, _) => "T7: first document, section 1.1",
            (Points::Vogel, Rotation::White, _) => "T8 with white noise instead: first document, section 1.2",
            (Points::Vogel, ..) => "T8: first document, section 1.2",
            (Points::Poisson, Rotation::Fixed, _) => "T5: second document, section 1",
            (Points::Poisson, Rotation::World, _) => "T6: second document, section 1",
            (Points::Poisson, ..) => {
                "T6 with screen-space noise (seed defect mended): second document, section 1"
            }
            (Points::Blue, ..) => "T9: first document, section 1.1",
            (Points::Spiral, ..) => "T31: excerpt of Real-Time Rendering; Jimenez 2014",
        };
        Info {
            title: match self.rotation {
                Rotation::Fixed => "PCF: a disc of fixed size, the same at every pixel",
                _ => "PCF: a disc of fixed size, turned from pixel to pixel",
            },
            document,
            options: format!("{}, {}", self.points.name(), self.rotation.name()),
            taps: self.tap.count(self.taps),
            stochastic: self.rotation != Rotation::Fixed,
        }
    }

    fn kernels(&self, calibration: Calibration) -> Kernels {
        match (self.projection, calibration) {
            (Projection::Cube, Calibration::AsPrinted) => Kernels::point_light(),
            _ => Kernels::fixed_disc(calibration),
        }
    }

    fn lights(&self) -> Lights {
        if self.projection == Projection::Cube { Lights::Placed } else { Lights::All }
    }

    fn projection(&self) -> Projection {
        self.projection
    }

    fn record(&self, recording: &mut Recording, inputs: &Inputs<'_>) {
        let law = if self.projection == Projection::Cube { Law::Point } else { Law::Standard };
        let technique = Shade {
            uses: vec![self.tap.fragment(), self.points.fragment(self.taps)],
            constants: vec![("FILTER_TAPS", f64::from(self.taps))],
            law,
            pattern: Some(self.rotation.fragment()),
            ..Shade::new("pcf-disc", OWN)
        };
        shade(recording, inputs, technique);
    }
}
