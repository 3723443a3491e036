//! One picture of another program: EXR or PNG, and the channel of it that holds a shadow.

use crate::exr_file::file_error;
use crate::{ExrError, Image, Layer, read_exr};
use std::path::Path;

/// A picture's channels.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// As in the file. Of a PNG the code values, 0 to 1.
    pub layers: Vec<Layer>,
    /// Bits of an integer format; none for floats.
    pub bits: Option<u8>,
}

/// How code values of an integer picture became light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transfer {
    /// They are in proportion to it.
    Linear,
    /// By sRGB's curve (IEC 61966-2-1), as screens and screen captures have them.
    Srgb,
}

/// Channels that are taken for a shadow without being told.
/// "reference.V" is what `umbrage reference` writes.
const SHADOW_NAMES: [&str; 7] = ["visibility.V", "reference.V", "shadow.V", "mask.V", "V", "Y", "shadow"];
/// Most pixels along a side.
const MAX_SIDE: u32 = 16384;

impl Picture {
    /// Reads `.exr` or `.png`.
    ///
    /// # Errors
    /// A file that is missing, truncated, of another kind, or announces more than 16384 pixels a side.
    pub fn read(path: &Path) -> Result<Self, ExrError> {
        let is = |kind: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(kind));
        if is("exr") {
            return Ok(Self { layers: read_exr(path)?, bits: None });
        }
        if !is("png") {
            return Err(file_error(path, "is neither .exr nor .png"));
        }
        let wrong = |e: image::ImageError| file_error(path, e);
        let file = std::fs::File::open(path).map_err(|e| file_error(path, e))?;
        let mut reader =
            image::ImageReader::with_format(std::io::BufReader::new(file), image::ImageFormat::Png);
        let mut limits = image::Limits::default();
        (limits.max_image_width, limits.max_image_height) = (Some(MAX_SIDE), Some(MAX_SIDE));
        reader.limits(limits);
        let decoded = reader.decode().map_err(wrong)?;
        let bits =
            if decoded.color().bytes_per_pixel() / decoded.color().channel_count() > 1 { 16 } else { 8 };
        let (width, height) = (decoded.width(), decoded.height());
        let values = decoded.into_rgb32f();
        let layer = |(k, name): (usize, &str)| {
            (name.to_string(), Image::from_pixels(width, height, values.pixels().map(|p| p.0[k]).collect()))
        };
        Ok(Self { layers: ["R", "G", "B"].into_iter().enumerate().map(layer).collect(), bits: Some(bits) })
    }

    /// Pixels per row and rows.
    pub fn size(&self) -> (u32, u32) {
        self.layers.first().map_or((0, 0), |l| (l.1.width(), l.1.height()))
    }

    /// The channel of this name; or the shadow, where none is named: one that is called so, the only one, or
    /// three that are equal.
    ///
    /// # Errors
    /// No such channel; the message lists those that are there.
    pub fn shadow(&self, wanted: Option<&str>) -> Result<&Image<f32>, String> {
        let named = |name: &str| self.layers.iter().find(|l| l.0 == name).map(|l| &l.1);
        if let Some(name) = wanted {
            return named(name).ok_or_else(|| format!("has no channel {name}; it has {}", self.names()));
        }
        if let Some(found) = SHADOW_NAMES.iter().find_map(|name| named(name)) {
            return Ok(found);
        }
        match (self.layers.as_slice(), named("R"), named("G"), named("B")) {
            ([only], ..) => Ok(&only.1),
            (_, Some(r), Some(g), Some(b)) if same(r, g) && same(g, b) => Ok(r),
            _ => Err(format!(
                "has no channel that is surely the shadow; name one with --channel: it has {}",
                self.names()
            )),
        }
    }

    /// The weight of light in R, G and B (Rec. 709), or the only channel.
    ///
    /// # Errors
    /// Neither; the message lists the channels that are there.
    pub fn luminance(&self) -> Result<Image<f32>, String> {
        match (self.layers.as_slice(), self.colours()) {
            (_, Some([r, g, b])) => Ok(Image::from_fn(r.width(), r.height(), |x, y| {
                0.2126 * r.at(x, y) + 0.7152 * g.at(x, y) + 0.0722 * b.at(x, y)
            })),
            ([only], _) => Ok(only.1.clone()),
            _ => Err(format!("has no channels R, G and B; it has {}", self.names())),
        }
    }

    /// R, G and B: bare, or of the first layer that is called a picture ("ViewLayer.Combined.R").
    fn colours(&self) -> Option<[&Image<f32>; 3]> {
        let of = |prefix: &str| {
            let channel = |c: &str| self.layers.iter().find(|l| l.0 == format!("{prefix}{c}")).map(|l| &l.1);
            Some([channel("R")?, channel("G")?, channel("B")?])
        };
        let prefixes = self.layers.iter().filter_map(|l| l.0.strip_suffix('R')).filter(|p| p.ends_with('.'));
        let mut combined =
            prefixes.filter(|p| ends_with(p.trim_end_matches('.'), &["combined", "beauty", "rgba"]));
        of("").or_else(|| combined.find_map(of))
    }

    /// Linear depth, where there is a channel of it: "Z", "depth.Z", "ViewLayer.Depth.V".
    pub fn depth(&self) -> Option<&Image<f32>> {
        let is_depth = |name: &str| {
            let layer = name.strip_suffix(".Z").or_else(|| name.strip_suffix(".V")).unwrap_or(name);
            name == "Z" || ends_with(layer, &["depth"])
        };
        self.layers.iter().find(|l| is_depth(&l.0)).map(|l| &l.1)
    }

    fn names(&self) -> String {
        self.layers.iter().map(|l| l.0.as_str()).collect::<Vec<_>>().join(", ")
    }
}

impl Transfer {
    /// The light of a code value, both 0 to 1.
    pub fn decode(self, code: f32) -> f32 {
        match self {
            Self::Linear => code,
            Self::Srgb if code <= 0.04045 => code / 12.92,
            Self::Srgb => ((code + 0.055) / 1.055).powf(2.4),
        }
    }

    /// How much light changes per code value at a light, so that a step of the format can be told.
    pub fn slope(self, light: f32) -> f32 {
        match self {
            Self::Linear => 1.0,
            Self::Srgb if light <= 0.003_130_8 => 1.0 / 12.92,
            Self::Srgb => 2.4 / 1.055 * light.powf(1.4 / 2.4),
        }
    }
}

/// Whether the last part of a dotted name is one of these, in any case.
fn ends_with(name: &str, words: &[&str]) -> bool {
    name.rsplit('.').next().is_some_and(|last| words.iter().any(|w| last.eq_ignore_ascii_case(w)))
}

fn same(a: &Image<f32>, b: &Image<f32>) -> bool {
    a.pixels().iter().zip(b.pixels()).all(|(a, b)| a.to_bits() == b.to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write_exr;

    fn picture(names: &[(&str, f32)]) -> Picture {
        let layer = |&(name, value): &(&str, f32)| (name.to_string(), Image::filled(2, 2, value));
        Picture { layers: names.iter().map(layer).collect(), bits: None }
    }

    #[test]
    fn the_shadow_is_found_or_asked_for() {
        let value = |p: &Picture, wanted| p.shadow(wanted).map(|i| *i.at(0, 0));
        assert_eq!(value(&picture(&[("depth.Z", 9.0), ("visibility.V", 0.5)]), None), Ok(0.5));
        assert_eq!(value(&picture(&[("anything", 0.25)]), None), Ok(0.25));
        assert_eq!(value(&picture(&[("B", 0.25), ("G", 0.25), ("R", 0.25)]), None), Ok(0.25));
        let colours = picture(&[("B", 0.1), ("G", 0.25), ("R", 0.25)]);
        assert_eq!(value(&colours, Some("G")), Ok(0.25));
        let unsure = colours.shadow(None).expect_err("unsure");
        assert!(unsure.contains("B, G, R") && unsure.contains("--channel"), "{unsure}");
        let missing = colours.shadow(Some("V")).expect_err("missing");
        assert!(missing.contains("no channel V") && missing.contains("B, G, R"), "{missing}");
    }

    #[test]
    fn layers_of_other_programs_are_known() {
        let names =
            ["ViewLayer.Combined.A", "ViewLayer.Combined.B", "ViewLayer.Combined.G", "ViewLayer.Combined.R"];
        let mut layers: Vec<(&str, f32)> = names.iter().map(|n| (*n, 0.5)).collect();
        layers.push(("ViewLayer.Depth.Z", 7.0));
        let blender = picture(&layers);
        assert_eq!(blender.luminance().map(|i| *i.at(0, 0)), Ok(0.5));
        assert_eq!(blender.depth().map(|i| *i.at(0, 0)), Some(7.0));
        assert_eq!(picture(&[("Z", 3.0), ("R", 1.0)]).depth().map(|i| *i.at(0, 0)), Some(3.0));
        assert_eq!(picture(&[("FinalImage.R", 1.0)]).depth(), None);
        assert!(picture(&[("x.R", 1.0), ("x.G", 1.0), ("x.B", 1.0)]).luminance().is_err());
    }

    #[test]
    fn curves_invert_and_have_their_slope() {
        for code in [0.0f32, 0.02, 0.2, 0.7, 1.0] {
            let light = Transfer::Srgb.decode(code);
            let step = 1e-3;
            let rise =
                (Transfer::Srgb.decode(code + step) - Transfer::Srgb.decode(code - step)) / (2.0 * step);
            // The curve has a corner at .04045; elsewhere its second derivative is below 4, times step.
            assert!((rise - Transfer::Srgb.slope(light)).abs() < 0.01, "{code}: {rise}");
        }
        assert_eq!(Transfer::Linear.decode(0.3), 0.3);
    }

    #[test]
    fn pngs_are_read_as_codes_and_damaged_ones_refused() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a.png");
        image::GrayImage::from_fn(3, 2, |x, _| image::Luma([x as u8 * 51])).save(&path).expect("written");
        let read = Picture::read(&path).expect("read");
        assert_eq!((read.size(), read.bits), ((3, 2), Some(8)));
        // Code 102 of 255, to rounding.
        assert!((read.shadow(None).expect("grey").pixels()[2] * 255.0 - 102.0).abs() < 1e-4);
        let bytes = std::fs::read(&path).expect("read");
        std::fs::write(&path, &bytes[..bytes.len() / 2]).expect("cut");
        assert!(Picture::read(&path).expect_err("cut").to_string().contains("a.png"));
        assert!(
            Picture::read(&folder.path().join("a.jpg")).expect_err("kind").to_string().contains("neither")
        );
        let path = folder.path().join("a.exr");
        write_exr(&path, &[("V".to_string(), Image::filled(4, 4, 0.5))]).expect("written");
        assert_eq!(Picture::read(&path).expect("read").bits, None);
    }
}
