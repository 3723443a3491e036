//! EXR files: the only float image contract with the outside.
//!
//! Channels are named `layer.V`, `layer.X` as viewers split them (at the last dot). Everything is
//! written as 32-bit float, ZIP-compressed, row 0 at the top, to a temporary name and renamed.

use crate::Image;
use exr::prelude as ex;
use std::path::{Path, PathBuf};

/// A named channel: `visibility.V`, `normal.X`, `R`.
pub type Layer = (String, Image<f32>);

/// Why an EXR file could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum ExrError {
    /// The library's or the system's reason.
    #[error("{}: {reason}", path.display())]
    File {
        /// Which file.
        path: PathBuf,
        /// What went wrong.
        reason: String,
    },
    /// The layers differ in size, or there are none.
    #[error("{}: layers of different sizes, or none: {sizes}", path.display())]
    Shape {
        /// Which file.
        path: PathBuf,
        /// The sizes found.
        sizes: String,
    },
}

/// Most pixels that a header may announce before the file is refused unread: 16384 squared, the
/// largest texture of common adapters.
const MAX_PIXELS: usize = 16384 * 16384;
/// Most values, of all channels: 4 GiB of floats, four channels of the largest picture.
const MAX_VALUES: usize = 4 * MAX_PIXELS;
/// A file that says much more than it holds is broken: DWAB packs a constant of 256 lines, the best case, into some
/// 300 bytes, which is 14,000 values a byte in the widest picture.
const MOST_VALUES_A_BYTE: usize = 1 << 16;

pub(crate) fn file_error(path: &Path, reason: impl ToString) -> ExrError {
    ExrError::File { path: path.into(), reason: reason.to_string() }
}

/// The library says of a file that ends too early only that bytes are missing.
fn read_error(path: &Path, error: &exr::error::Error) -> ExrError {
    let reason = error.to_string();
    let ends_early =
        ["missing bytes", "failed to fill whole buffer", "reference to"].iter().any(|w| reason.contains(w));
    match ends_early {
        true => file_error(path, format!("is truncated or broken ({reason}): write it again")),
        false => file_error(path, reason),
    }
}

/// Writes layers of one size.
///
/// # Errors
/// Unequal sizes, or a file that cannot be written; a half-written file is never left behind.
pub fn write_exr(path: &Path, layers: &[Layer]) -> Result<(), ExrError> {
    let size_of = |l: &Layer| (l.1.width() as usize, l.1.height() as usize);
    let size = layers.first().map(size_of).filter(|&s| layers.iter().all(|l| size_of(l) == s));
    let Some(size) = size else {
        let sizes = layers.iter().map(|l| format!("{} {:?}", l.0, size_of(l))).collect::<Vec<_>>().join(", ");
        return Err(ExrError::Shape { path: path.into(), sizes });
    };
    let channel = |(name, image): &Layer| {
        ex::AnyChannel::new(name.as_str(), ex::FlatSamples::F32(image.pixels().to_vec()))
    };
    let channels = ex::AnyChannels::sort(layers.iter().map(channel).collect());
    let encoding = ex::Encoding { compression: ex::Compression::ZIP16, ..ex::Encoding::FAST_LOSSLESS };
    let layer = ex::Layer::new(size, ex::LayerAttributes::named(""), encoding, channels);
    let mut image = ex::Image::from_layer(layer);
    image.layer_data.attributes.layer_name = None;
    image.attributes.chromaticities = None;
    let temporary = path.with_extension(format!("exr.{}.tmp", std::process::id()));
    use ex::WritableImage as _;
    let written = image.write().to_file(&temporary).map_err(|e| file_error(path, e));
    let moved = written.and_then(|()| std::fs::rename(&temporary, path).map_err(|e| file_error(path, e)));
    if moved.is_err() {
        let _ = std::fs::remove_file(&temporary);
    }
    moved
}

/// Reads every channel of every part as 32-bit floats, in the file's order.
///
/// # Errors
/// A file that is missing, truncated, no EXR, or announces more than 16384 x 16384 pixels.
pub fn read_exr(path: &Path) -> Result<Vec<Layer>, ExrError> {
    let meta = ex::MetaData::read_from_file(path, false).map_err(|e| read_error(path, &e))?;
    let bytes = std::fs::metadata(path).map_err(|e| file_error(path, e))?.len() as usize;
    let mut values = 0usize;
    for header in &meta.headers {
        let ex::Vec2(width, height) = header.layer_size;
        let channels = header.channels.list.len();
        let too_large = |what: &str| {
            Err(file_error(
                path,
                format!("announces {width} x {height} pixels in {channels} channels, {what}"),
            ))
        };
        if header.layer_size.area() > MAX_PIXELS {
            return too_large("more than 16384 x 16384 pixels");
        }
        values = values.saturating_add(header.layer_size.area().saturating_mul(channels));
        if values > MAX_VALUES {
            return too_large("more than 4 GiB of values: write the channels that are scored alone");
        }
        if values > bytes.saturating_mul(MOST_VALUES_A_BYTE) {
            return too_large(&format!("but has {bytes} bytes: it is truncated or broken"));
        }
    }
    use ex::{ReadChannels as _, ReadLayers as _};
    let reader =
        ex::read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let image = reader.from_file(path).map_err(|e| read_error(path, &e))?;
    let mut layers = Vec::new();
    let whole = image.attributes.display_window;
    for part in image.layer_data {
        if part.attributes.layer_position != whole.position || part.size != whole.size {
            return Err(file_error(
                path,
                format!(
                    "its data window ({}x{} at {}, {}) is not its display window ({}x{} at {}, {}): write whole pictures, \
                     without overscan or crop",
                    part.size.0,
                    part.size.1,
                    part.attributes.layer_position.0,
                    part.attributes.layer_position.1,
                    whole.size.0,
                    whole.size.1,
                    whole.position.0,
                    whole.position.1
                ),
            ));
        }
        let (width, height) = (part.size.0 as u32, part.size.1 as u32);
        let prefix = part.attributes.layer_name.map(|n| format!("{n}.")).unwrap_or_default();
        for channel in part.channel_data.list {
            let pixels = channel.sample_data.values_as_f32().collect();
            layers.push((format!("{prefix}{}", channel.name), Image::from_pixels(width, height, pixels)));
        }
    }
    Ok(layers)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_come_back_bit_for_bit() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("layers.exr");
        let ramp = Image::from_fn(5, 3, |x, y| x as f32 * 0.1 + y as f32 * 7.0);
        let layers = vec![("depth.Z".to_string(), ramp.map(|v| v + 0.5)), ("visibility.V".to_string(), ramp)];
        write_exr(&path, &layers).expect("written");
        assert_eq!(read_exr(&path).expect("read"), layers);
        assert_eq!(std::fs::read_dir(folder.path()).expect("listed").count(), 1, "no temporary file is left");
    }

    #[test]
    fn a_truncated_file_is_an_error_that_names_it() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("cut.exr");
        write_exr(&path, &[("R".to_string(), Image::filled(64, 64, 0.25))]).expect("written");
        let bytes = std::fs::read(&path).expect("read");
        std::fs::write(&path, &bytes[..bytes.len() / 2]).expect("cut");
        let message = read_exr(&path).expect_err("truncated").to_string();
        assert!(message.contains("cut.exr") && message.contains("truncated"), "{message}");
        std::fs::write(&path, "").expect("emptied");
        let message = read_exr(&path).expect_err("empty").to_string();
        assert!(message.contains("truncated"), "{message}");
    }

    /// So many channels of so many pixels, and a few hundred bytes.
    #[test]
    fn a_header_that_announces_too_much_is_refused_before_memory_is_asked_for() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("huge.exr");
        let refused = |(channels, side): (usize, u32), words: &str| {
            let layer = |k: usize| (format!("l{k}.V"), Image::filled(4, 4, 0.5));
            write_exr(&path, &(0..channels).map(layer).collect::<Vec<_>>()).expect("written");
            let mut bytes = std::fs::read(&path).expect("read");
            for name in ["dataWindow", "displayWindow"] {
                let wanted = format!("{name}\0box2i\0");
                let at = bytes.windows(wanted.len()).position(|w| w == wanted.as_bytes()).expect("a window");
                let at = at + wanted.len() + 4 + 8;
                for corner in [at, at + 4] {
                    bytes[corner..corner + 4].copy_from_slice(&(side - 1).to_le_bytes());
                }
            }
            std::fs::write(&path, bytes).expect("written");
            let message = read_exr(&path).expect_err(words).to_string();
            assert!(message.contains("huge.exr") && message.contains(words), "{message}");
        };
        refused((1, 100_000), "announces 100000 x 100000 pixels in 1 channels");
        refused((41, 16_384), "more than 4 GiB of values");
        refused((1, 16_384), "it is truncated or broken");
    }
}
