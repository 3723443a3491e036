//! What a material's pictures say at a place of their own: whether a texel is there at all, and its
//! colour.
//!
//! Deliberately absent: filtering of masks and levels of detail. A cut-out surface is there or not,
//! texel by texel, decided once when it is read: truth and raster ask for the same bit.

use glam::{DVec2, Vec3};
use std::sync::Arc;

/// What lies beyond a picture's edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// Its last texel.
    Clamp,
    /// The picture turned over.
    Mirror,
}

/// A bit for each texel: set where the surface is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AlphaMask {
    size: [u32; 2],
    wrap: [Wrap; 2],
    bits: Arc<[u32]>,
}

/// A picture of linear colours, for shaded pictures alone.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    size: [u32; 2],
    wrap: [Wrap; 2],
    texels: Arc<[[u8; 3]]>,
}

/// Longest side that a texture keeps: shaded pictures are a few hundred pixels wide.
const KEPT_TEXELS: u32 = 1024;

impl Wrap {
    /// The texel that stands for the one at `at`, of `size`.
    #[inline(always)]
    fn texel(self, at: i64, size: u32) -> u32 {
        let size = i64::from(size);
        let inside = match self {
            _ if (0..size).contains(&at) => at,
            Self::Repeat => at.rem_euclid(size),
            Self::Clamp => at.clamp(0, size - 1),
            Self::Mirror => {
                let there_and_back = at.rem_euclid(2 * size);
                there_and_back.min(2 * size - 1 - there_and_back)
            }
        };
        inside as u32
    }
}

impl AlphaMask {
    /// Of `[width, height]` texels, neither of them 0; rows from the top, as glTF counts v.
    ///
    /// # Panics
    /// When a side is 0: a programming error, never a user's.
    pub fn new(size: [u32; 2], wrap: [Wrap; 2], is_opaque: impl Fn(u32, u32) -> bool) -> Self {
        assert!(size[0] > 0 && size[1] > 0, "a mask of {size:?} texels");
        let count = size[0] as usize * size[1] as usize;
        let mut bits = vec![0u32; count.div_ceil(32)];
        for texel in 0..count {
            let [x, y] = [texel % size[0] as usize, texel / size[0] as usize].map(|c| c as u32);
            bits[texel / 32] |= u32::from(is_opaque(x, y)) << (texel % 32);
        }
        Self { size, wrap, bits: bits.into() }
    }

    /// Whether it depends on the place.
    pub(crate) fn varies(&self) -> bool {
        self.size != [1, 1]
    }

    /// Whether the surface is there: at the texel `floor(uv * size)`.
    #[inline(always)]
    pub fn is_opaque(&self, uv: DVec2) -> bool {
        let [width, height] = self.size;
        // A place that is not finite becomes some texel or other.
        let x = self.wrap[0].texel((uv.x * f64::from(width)).floor() as i64, width);
        let y = self.wrap[1].texel((uv.y * f64::from(height)).floor() as i64, height);
        let texel = y as usize * width as usize + x as usize;
        self.bits[texel / 32] >> (texel % 32) & 1 != 0
    }

    /// Texels per row, and rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Beyond the edges along u and along v.
    pub fn wrap(&self) -> [Wrap; 2] {
        self.wrap
    }

    /// Texels row by row, the first in the lowest bit.
    pub fn bits(&self) -> &[u32] {
        &self.bits
    }

    /// Whether nothing is cut out.
    pub(crate) fn is_whole(&self) -> bool {
        let texels = self.size[0] as usize * self.size[1] as usize;
        self.bits.iter().map(|word| word.count_ones() as usize).sum::<usize>() == texels
    }
}

impl Texture {
    /// Of sRGB texels, rows from the top; halved until it is no wider or higher than 1024.
    pub(crate) fn new(size: [u32; 2], wrap: [Wrap; 2], texels: Vec<[u8; 3]>) -> Self {
        let (mut size, mut texels) = (size, texels);
        while size[0].max(size[1]) > KEPT_TEXELS {
            (size, texels) = halved(size, &texels);
        }
        Self { size, wrap, texels: texels.into() }
    }

    /// Linear colour, between the four nearest texels.
    pub fn colour(&self, uv: DVec2) -> Vec3 {
        let [width, height] = self.size;
        let at = uv * DVec2::new(width.into(), height.into()) - 0.5;
        let (first, part) = (at.floor(), (at - at.floor()).as_vec2());
        let texel = |right: i64, down: i64| {
            let x = self.wrap[0].texel(first.x as i64 + right, width) as usize;
            let y = self.wrap[1].texel(first.y as i64 + down, height) as usize;
            linear(self.texels[y * width as usize + x])
        };
        let row = |down: i64| texel(0, down).lerp(texel(1, down), part.x);
        row(0).lerp(row(1), part.y)
    }
}

/// Means of two by two texels; one row or column stays one.
fn halved([width, height]: [u32; 2], texels: &[[u8; 3]]) -> ([u32; 2], Vec<[u8; 3]>) {
    let size = [width, height].map(|side| (side / 2).max(1));
    let at = |x: u32, y: u32| {
        linear(texels[y.min(height - 1) as usize * width as usize + x.min(width - 1) as usize])
    };
    let mean = |x: u32, y: u32| {
        let sum = at(2 * x, 2 * y) + at(2 * x + 1, 2 * y) + at(2 * x, 2 * y + 1) + at(2 * x + 1, 2 * y + 1);
        encoded(0.25 * sum)
    };
    let rows = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    (size, rows.map(|(x, y)| mean(x, y)).collect())
}

/// IEC 61966-2-1.
fn linear(srgb: [u8; 3]) -> Vec3 {
    Vec3::from_array(srgb.map(|byte| {
        let c = f32::from(byte) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    }))
}

fn encoded(colour: Vec3) -> [u8; 3] {
    colour.to_array().map(|c| {
        let c = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
        (c * 255.0).round() as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three texels, the first there; places on either side of the picture.
    #[test]
    fn beyond_the_edge_a_mask_repeats_ends_or_turns() {
        let row = |wrap: Wrap| {
            let mask = AlphaMask::new([3, 1], [wrap; 2], |x, _| x == 0);
            (-4..7).map(|t| mask.is_opaque(DVec2::new((f64::from(t) + 0.5) / 3.0, 7.3))).collect::<Vec<_>>()
        };
        let at = |places: &[usize]| (0..11).map(|t| places.contains(&t)).collect::<Vec<_>>();
        assert_eq!(row(Wrap::Repeat), at(&[1, 4, 7, 10]));
        assert_eq!(row(Wrap::Clamp), at(&[0, 1, 2, 3, 4]));
        assert_eq!(row(Wrap::Mirror), at(&[3, 4, 9, 10]));
    }

    #[test]
    fn texels_are_closed_on_the_left_and_above() {
        let mask = AlphaMask::new([2, 2], [Wrap::Clamp; 2], |x, y| x == y);
        assert!(mask.is_opaque(DVec2::new(0.5, 0.5)));
        assert!(!mask.is_opaque(DVec2::new(0.5, 0.499)));
        assert!(mask.is_opaque(DVec2::new(0.499, 0.499)));
        assert!(!mask.is_whole() && AlphaMask::new([5, 7], [Wrap::Repeat; 2], |_, _| true).is_whole());
    }

    /// Halving keeps the mean light: half of the texels white is a linear .5 within a byte's step.
    #[test]
    fn a_large_picture_keeps_its_light_when_halved() {
        let texels = (0..2048 * 4).map(|t| [if t % 2 == 0 { 255 } else { 0 }; 3]).collect();
        let texture = Texture::new([2048, 4], [Wrap::Repeat; 2], texels);
        assert_eq!(texture.size, [1024, 2]);
        let step = linear([189; 3]).x - linear([188; 3]).x;
        assert!((texture.colour(DVec2::new(0.3, 0.7)).x - 0.5).abs() < step);
    }
}
