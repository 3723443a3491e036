//! PNG files with a palette: a third of the size of colour ones.
//!
//! The encoder at hand writes grey pictures but no palettes. The two differ in one byte of the
//! header and in one chunk (PNG specification, third edition, 11.2.1 and 11.2.2), put in here.

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _};
use umbrage_frame::Image;

/// Signature (8), then the header chunk: length (4), name (4), 13 bytes, checksum (4).
const HEADER_END: usize = 8 + 4 + 4 + 13 + 4;
/// Width (4), height (4) and depth (1) come before the colour type.
const COLOUR_TYPE: usize = 8 + 4 + 4 + 9;
const INDEXED: u8 = 3;

/// Pixels are places in a palette of at most 256 colours.
pub(super) fn indexed(pixels: &Image<u8>, palette: &[[u8; 3]]) -> Result<Vec<u8>, String> {
    let size = (pixels.width(), pixels.height());
    let grey = compress(pixels.pixels(), size, ExtendedColorType::L8)?;
    let (head, rest) = grey.split_at_checked(HEADER_END).ok_or("the encoder wrote no header")?;
    let mut png = head.to_vec();
    png[COLOUR_TYPE] = INDEXED;
    let checksum = crc32(&png[12..HEADER_END - 4]);
    png[HEADER_END - 4..].copy_from_slice(&checksum.to_be_bytes());
    append_chunk(&mut png, *b"PLTE", palette.as_flattened());
    png.extend_from_slice(rest);
    Ok(png)
}

/// Plain 8-bit colour.
pub(super) fn rgb(pixels: &Image<[u8; 3]>) -> Result<Vec<u8>, String> {
    let size = (pixels.width(), pixels.height());
    compress(pixels.pixels().as_flattened(), size, ExtendedColorType::Rgb8)
}

fn compress(bytes: &[u8], size: (u32, u32), colour: ExtendedColorType) -> Result<Vec<u8>, String> {
    let mut png = Vec::new();
    let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive);
    encoder.write_image(bytes, size.0, size.1, colour).map_err(|e| e.to_string())?;
    Ok(png)
}

fn append_chunk(png: &mut Vec<u8>, name: [u8; 4], data: &[u8]) {
    png.extend_from_slice(&(data.len() as u32).to_be_bytes());
    let start = png.len();
    png.extend_from_slice(&name);
    png.extend_from_slice(data);
    let checksum = crc32(&png[start..]);
    png.extend_from_slice(&checksum.to_be_bytes());
}

/// The checksum of PNG chunks (PNG specification, annex D), bit by bit: a palette is short.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| if crc & 1 == 1 { 0xEDB8_8320 ^ (crc >> 1) } else { crc >> 1 };
    !bytes.iter().fold(!0, |crc: u32, &byte| (0..8).fold(crc ^ u32::from(byte), |c, _| step(c)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decoder_finds_the_colours_of_the_palette() {
        let palette: Vec<[u8; 3]> = (0..=255).map(|i| [i, 255 - i, i / 2]).collect();
        let pixels = Image::from_fn(31, 17, |x, y| (x * 7 + y * 13) as u8);
        let png = indexed(&pixels, &palette).expect("encoded");
        let back = image::load_from_memory(&png).expect("decoded").into_rgb8();
        assert_eq!(back.dimensions(), (31, 17));
        for (x, y, pixel) in back.enumerate_pixels() {
            assert_eq!(pixel.0, palette[usize::from(*pixels.at(x, y))]);
        }
    }

    #[test]
    fn checksum_of_the_specification() {
        // The end chunk of every PNG file carries this one.
        assert_eq!(crc32(b"IEND"), 0xAE42_6082);
    }
}
