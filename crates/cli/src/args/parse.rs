//! Values with a form of their own.

use umbrage_shadows::{Bias, ConstantBias, ReceiverPlane};

/// The largest texture of common adapters.
const MAX_SIDE: u32 = 16_384;

/// 7680 x 4320: a window of 16 frames and 4 seeds takes 256 bytes a pixel.
const MAX_PIXELS: u64 = 7680 * 4320;

/// Lights are counted from 1.
pub(super) fn parse_light(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|&light| light > 0).ok_or_else(|| "lights are numbered from 1".into())
}

pub(super) fn parse_bias(text: &str) -> Result<Bias, String> {
    let expected = "expected metres,texels,slope as in 0.001,0.5,5 (the slope may be `off`)";
    let parts: Vec<&str> = text.split(',').map(str::trim).collect();
    let [constant, offset, slope] = parts[..] else { return Err(expected.into()) };
    let number = |s: &str| s.parse::<f64>().ok().filter(|v| v.is_finite() && *v >= 0.0).ok_or(expected);
    Ok(Bias {
        constant: ConstantBias::World(number(constant)?),
        normal_offset_texels: number(offset)?,
        receiver_plane: match slope {
            "off" => ReceiverPlane::Off,
            _ => ReceiverPlane::On { max_slope: number(slope)? },
        },
    })
}

pub(super) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let (width, height) = text.split_once(['x', 'X']).ok_or("expected WIDTHxHEIGHT, as in 1920x1080")?;
    let side = |s: &str| s.trim().parse::<u32>().map_err(|e| format!("\"{s}\" is no size: {e}"));
    check_size((side(width)?, side(height)?))
}

/// A size that can be rendered: refused here, before truth takes all memory for it.
pub(crate) fn check_size((width, height): (u32, u32)) -> Result<(u32, u32), String> {
    if width == 0 || height == 0 {
        return Err("a picture has at least one pixel a side".into());
    }
    if width.max(height) > MAX_SIDE {
        return Err(format!("a picture has at most {MAX_SIDE} pixels a side"));
    }
    match u64::from(width) * u64::from(height) {
        pixels if pixels > MAX_PIXELS => {
            Err(format!("a picture has at most {MAX_PIXELS} pixels (8K), not {pixels}"))
        }
        _ => Ok((width, height)),
    }
}

/// A standard error of V.
pub(super) fn parse_tolerance(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(value) if value > 0.0 && value < 1.0 => Ok(value),
        _ => Err("a standard error between 0 and 1, such as 0.002".into()),
    }
}
