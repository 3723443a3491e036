//! Planes of half floats as text: two bytes a value, differences where they help, deflated, base64.
//!
//! Layout before deflation: one byte that says whether values are differences (1) or not (0), then
//! the upper bytes of all frames, then the lower ones. A difference is taken between the bits of
//! two half floats, modulo 2^16: of the first frame to its left neighbour, of later ones to the
//! same pixel of the frame before.

use flate2::Compression;
use flate2::write::ZlibEncoder;
use half::f16;
use std::io::Write as _;
use umbrage_frame::Image;

/// All of one NaN: its bits must not differ between frames.
const NAN: u16 = 0x7E00;

/// Frames of one size as base64.
pub(super) fn text(frames: &[&Image<f32>]) -> std::io::Result<String> {
    let plain: Vec<Vec<u16>> = frames.iter().map(|f| bits(f)).collect();
    let width = frames.first().map_or(0, |f| f.width() as usize);
    let candidates = [(0, &plain), (1, &differences(&plain, width))];
    let mut packed = candidates.map(|(way, frames)| deflated(way, frames));
    packed.sort_by_key(|p| p.as_ref().map_or(usize::MAX, Vec::len));
    let [smallest, _] = packed;
    Ok(base64::encode(smallest?))
}

fn bits(frame: &Image<f32>) -> Vec<u16> {
    let bits = |&v: &f32| if v.is_nan() { NAN } else { f16::from_f32(v).to_bits() };
    frame.pixels().iter().map(bits).collect()
}

fn differences(frames: &[Vec<u16>], width: usize) -> Vec<Vec<u16>> {
    let left = |frame: &[u16], i: usize| if i.is_multiple_of(width) { 0 } else { frame[i - 1] };
    let one = |(t, frame): (usize, &Vec<u16>)| {
        let before = |i| if t == 0 { left(frame, i) } else { frames[t - 1][i] };
        frame.iter().enumerate().map(|(i, v)| v.wrapping_sub(before(i))).collect()
    };
    frames.iter().enumerate().map(one).collect()
}

fn deflated(way: u8, frames: &[Vec<u16>]) -> std::io::Result<Vec<u8>> {
    let mut bytes = vec![way];
    bytes.extend(frames.iter().flatten().map(|v| (v >> 8) as u8));
    bytes.extend(frames.iter().flatten().map(|v| *v as u8));
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(&bytes)?;
    encoder.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read as _;

    /// As the page's own script does it.
    fn decoded(text: &str, pixels: usize, width: usize) -> Vec<f32> {
        let packed = base64::decode(text).expect("base64");
        let mut bytes = Vec::new();
        flate2::read::ZlibDecoder::new(packed.as_slice()).read_to_end(&mut bytes).expect("deflated");
        let count = (bytes.len() - 1) / 2;
        let mut values: Vec<u16> =
            (0..count).map(|i| u16::from(bytes[1 + i]) << 8 | u16::from(bytes[1 + count + i])).collect();
        for i in (0..count).filter(|_| bytes[0] == 1) {
            let before = match (i < pixels, i % width) {
                (true, 0) => 0,
                (true, _) => values[i - 1],
                (false, _) => values[i - pixels],
            };
            values[i] = values[i].wrapping_add(before);
        }
        values.into_iter().map(|v| f16::from_bits(v).to_f32()).collect()
    }

    #[test]
    fn frames_come_back_as_half_floats_whichever_way_they_were_packed() {
        let smooth = Image::from_fn(31, 7, |x, y| if x == 3 { f32::NAN } else { (x * 7 + y) as f32 / 300.0 });
        let moved = smooth.map(|v| v + 0.01);
        let rough = Image::from_fn(31, 7, |x, y| ((x * 7919 + y * 104_729) % 17) as f32 / 16.0);
        for frames in [vec![&smooth, &moved], vec![&rough], vec![&rough, &smooth, &rough]] {
            let back = decoded(&text(&frames).expect("packed"), 31 * 7, 31);
            let wanted = frames.iter().flat_map(|f| f.pixels());
            for (a, b) in back.iter().zip(wanted) {
                // The nearest half float, bit for bit.
                assert!(a.is_nan() && b.is_nan() || *a == f16::from_f32(*b).to_f32(), "{a} {b}");
            }
            assert_eq!(back.len(), frames.len() * 31 * 7);
        }
    }
}
