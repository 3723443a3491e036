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

pub(crate) fn file_error(path: &Path, reason: impl ToString) -> ExrError {
    ExrError::File { path: path.into(), reason: reason.to_string() }
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
    let meta = ex::MetaData::read_from_file(path, false).map_err(|e| file_error(path, e))?;
    for header in &meta.headers {
        if header.layer_size.area() > MAX_PIXELS {
            return Err(file_error(
                path,
                format!("announces {:?} pixels, more than 16384 x 16384", header.layer_size),
            ));
        }
    }
    use ex::{ReadChannels as _, ReadLayers as _};
    let reader =
        ex::read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let image = reader.from_file(path).map_err(|e| file_error(path, e))?;
    let mut layers = Vec::new();
    let whole = image.attributes.display_window;
    for part in image.layer_data {
        if part.attributes.layer_position != whole.position || part.size != whole.size {
            return Err(file_error(
                path,
                format!(
                    "its data window ({:?} at {:?}) is not its display window ({:?}): write whole pictures, without overscan \
                     or crop",
                    part.size, part.attributes.layer_position, whole
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
        assert!(read_exr(&path).expect_err("truncated").to_string().contains("cut.exr"));
    }
}
