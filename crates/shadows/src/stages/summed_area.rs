//! A summed-area table of depth and its square (T25), in whole numbers whose sums may wrap.

use super::shadow_map;
use crate::calibration::PRINTED_RADIUS_UV;
use crate::recording::{Binding, ComputePass, Format, Pass, Recording, TextureId, TextureInfo};
use crate::{Calibration, Inputs, LightMap, shader};

/// How depths are stored, and for which boxes that is enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fixed {
    /// Bits of a texel's fraction.
    pub(crate) bits: u32,
    /// Widest box, in texels.
    pub(crate) widest: f64,
}

/// Boxes wider than this are cut: each doubling costs two bits of every depth.
pub(crate) const WIDEST: f64 = 128.0;

/// More bits than this a float depth does not have.
const MOST_BITS: u32 = 22;

impl Fixed {
    /// For the widest kernel or search of a calibration: as many bits as leave the sum of so many
    /// texels, and of the edges that a box cuts, below 2^31.
    pub(crate) fn new(calibration: Calibration, light: &LightMap) -> Self {
        let radius_uv = match calibration {
            Calibration::AsPrinted => PRINTED_RADIUS_UV,
            Calibration::LightMatched => light.true_radius_uv(light.far, light.nearest_blocker).into(),
        };
        let widest = (2.0 * radius_uv * f64::from(light.texels)).ceil().clamp(1.0, WIDEST);
        let largest_sum_bits = (2.0 * (widest + 2.0).log2()).ceil() as u32;
        Self { bits: (31 - largest_sum_bits).min(MOST_BITS), widest }
    }

    /// Variance that rounding to these bits may feign, in squares of the far plane's distance: with
    /// depth c in -1..1, half a step of c^2 and two of c.
    pub(crate) fn variance(self, light: &LightMap) -> f64 {
        let unit = f64::from(0.5 * (light.far - light.nearest_blocker) / light.far);
        2.5 * unit * unit / f64::from(self.bits).exp2()
    }

    /// Constants of the table's writer and reader.
    pub(crate) fn constants(self) -> Vec<(&'static str, f64)> {
        vec![("TABLE_BITS", self.bits.into()), ("TABLE_WIDEST", self.widest)]
    }
}

/// Sums of everything above and left of each texel, itself included; kept as long as the map is.
pub(crate) fn summed_area(recording: &mut Recording, inputs: &Inputs<'_>, fixed: Fixed) -> TextureId {
    let map = shadow_map(recording, inputs);
    let mut source = map;
    for (axis, label) in ["table-rows", "table"].into_iter().enumerate() {
        let info = recording.info(map).clone();
        let kept = info.kept.map(|key| key ^ u64::from(fixed.bits).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let destination =
            recording.texture(TextureInfo { label, format: Format::Rg32Uint, kept, ..info.clone() });
        let summand = match axis {
            0 => vec![shader::SUMMAND_DEPTH, shader::MOMENT_DEPTH],
            _ => vec![shader::SUMMAND_TABLE],
        };
        let mut shader = vec![shader::TABLE_LINE, shader::GLOBALS];
        shader.extend(summand);
        let mut constants = fixed.constants();
        constants.push(("AXIS", axis as f64));
        let bindings = vec![Binding::Globals, Binding::Source(source), Binding::Destination(destination)];
        // A group a line.
        let groups = [info.width, 1];
        let pass = ComputePass { label, shader, entry: "table_line", constants, bindings, groups };
        recording.passes.push(Pass::Compute(pass));
        source = destination;
    }
    source
}
