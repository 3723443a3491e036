//! PNG and JPEG files.

use crate::texture::{AlphaMask, Texture, Wrap};
use image::{ImageReader, Limits, RgbaImage};
use std::io::Cursor;

/// Longest side of a picture that is read: 1 GiB of texels.
const LARGEST: u32 = 16_384;

/// A picture in memory: 8 bits a channel, sRGB, rows from the top.
#[derive(Clone, Debug)]
pub(crate) struct Picture {
    rgba: RgbaImage,
    has_alpha: bool,
}

/// What makes a surface be there.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Opacity {
    /// Alpha times a factor, from a cutoff on (glTF 2.0, section 3.9.4).
    Alpha { factor: f32, cutoff: f32 },
    /// An OBJ library's `map_d`: its alpha if it has one, else its brightness, from a half on.
    Dissolve,
}

impl Picture {
    /// The message says what is wrong, not with which file.
    pub(crate) fn decode(bytes: &[u8]) -> Result<Self, String> {
        let mut reader = ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| format!("cannot be read: {error}"))?;
        let mut limits = Limits::default();
        limits.max_image_width = Some(LARGEST);
        limits.max_image_height = Some(LARGEST);
        limits.max_alloc = Some(1 << 31);
        reader.limits(limits);
        let decoded = reader.decode().map_err(|error| {
            format!("{error} (PNG and JPEG of up to {LARGEST} texels a side are read: convert it)")
        })?;
        if decoded.width() == 0 || decoded.height() == 0 {
            return Err("it has no texels".to_owned());
        }
        Ok(Self { has_alpha: decoded.color().has_alpha(), rgba: decoded.into_rgba8() })
    }

    /// Which texels are there.
    pub(crate) fn mask(&self, wrap: [Wrap; 2], opacity: Opacity) -> AlphaMask {
        let is_opaque = |x, y| {
            let [r, g, b, a] = self.rgba.get_pixel(x, y).0;
            match opacity {
                Opacity::Alpha { factor, cutoff } => f32::from(a) / 255.0 * factor >= cutoff,
                Opacity::Dissolve if self.has_alpha => a >= 128,
                Opacity::Dissolve => u32::from(r) + u32::from(g) + u32::from(b) >= 3 * 128,
            }
        };
        AlphaMask::new(self.rgba.dimensions().into(), wrap, is_opaque)
    }

    pub(crate) fn texture(&self, wrap: [Wrap; 2]) -> Texture {
        let texels = self.rgba.pixels().map(|pixel| [pixel.0[0], pixel.0[1], pixel.0[2]]).collect();
        Texture::new(self.rgba.dimensions().into(), wrap, texels)
    }
}
