//! A path as an animation: with every surface point held where it is, and as its cameras see it.

use super::Chosen;
use super::crops::{check_size, cut, one_line};
use super::points::maps;
use crate::ReportError;
use crate::picture::shade;
use crate::store::{read_series, read_truth_series};
use crate::words::full_name;
use png::{BitDepth, ColorType, Encoder};
use umbrage_frame::Image;

const FRAMES_PER_SECOND: u16 = 10;
const GAP: u32 = 8;

/// Writes `path-follow.png` and `path-camera.png` (APNG) where frames are stored; returns what they show.
pub(super) fn write(
    chosen: &Chosen,
    put: &mut impl FnMut(&str, &[u8]) -> Result<(), ReportError>,
) -> Result<String, ReportError> {
    let stored = |v: &&usize| {
        let mut here = chosen.index.variants.iter().filter(|s| s.window == chosen.window);
        here.any(|s| s.variant == **v && s.frames > 1)
    };
    let variants: Vec<usize> = chosen.variants.iter().filter(stored).copied().collect();
    if variants.is_empty() {
        return Ok("No frames are stored for this window: no animation.\n".into());
    }
    let Some(surface) = &chosen.pictures.surface else {
        return Ok("No cameras are stored for this window: no animation.\n".into());
    };
    let frames = surface.cameras.len();
    let mut columns = vec![truth(chosen, frames)?];
    for &v in &variants {
        columns.push(read_series(chosen.run, chosen.window, v)?);
    }
    if let Some(short) = columns.iter().map(Vec::len).find(|&n| n != frames) {
        return Ok(format!("{short} frames are stored for {frames} cameras: no animation.\n"));
    }
    let maps = maps(&surface.depth, &surface.cameras);
    // A pinned point fills the picture; a moving camera needs all of it.
    let crop = chosen.crops.first().copied();
    let follow = |t: usize| {
        columns.iter().map(|c| crop.map_or_else(|| c[t].clone(), |crop| cut(&c[t], crop))).collect::<Vec<_>>()
    };
    let camera = |t: usize| columns.iter().map(|c| moved(&c[t], &maps[t])).collect::<Vec<_>>();
    let zoom =
        crop.map_or(chosen.times, |c| (chosen.times * surface.depth.width()).div_ceil(2 * c[2]).max(1));
    put("path-follow.png", &animation(chosen, (frames, zoom), follow)?)?;
    put("path-camera.png", &animation(chosen, (frames, chosen.times), camera)?)?;
    let names: Vec<String> =
        variants.iter().map(|&v| one_line(&full_name(&chosen.card.variants[v]))).collect();
    Ok(format!(
        "path-follow.png (APNG): surface points held still, what moves is swimming. path-camera.png (APNG): the same points \
         moved with each frame's camera. Left to right: truth; {}. An MP4 beside them is lossy: an illustration, not data.\n",
        names.join("; ")
    ))
}

/// Truth of each frame: the same picture where the light stands still.
fn truth(chosen: &Chosen, frames: usize) -> Result<Vec<Image<f32>>, ReportError> {
    if chosen.index.truth_series.contains(&chosen.window) {
        return read_truth_series(chosen.run, chosen.window);
    }
    Ok(vec![chosen.pictures.truth.clone(); frames])
}

fn animation(
    chosen: &Chosen,
    (frames, times): (usize, u32),
    frame: impl Fn(usize) -> Vec<Image<f32>>,
) -> Result<Vec<u8>, ReportError> {
    let broken = |e: png::EncodingError| ReportError::Picture { name: "path".into(), reason: e.to_string() };
    let first = frame(0);
    let (width, height) = (first[0].width() * times, first[0].height() * times);
    let columns = first.len() as u32 * (width + GAP) - GAP;
    check_size(chosen, (columns, height))?;
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, columns, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_animated(frames as u32, 0).map_err(broken)?;
    encoder.set_frame_delay(1, FRAMES_PER_SECOND).map_err(broken)?;
    let mut writer = encoder.write_header().map_err(broken)?;
    for t in 0..frames {
        let planes = frame(t);
        let pixel = |x: u32, y: u32| {
            let (panel, inside) = (x / (width + GAP), x % (width + GAP));
            let (column, row) = (inside / times, y / times);
            if inside >= width {
                [255; 3]
            } else {
                shade(*planes[panel as usize].at(column, row), column, row)
            }
        };
        let picture = Image::from_fn(columns, height, pixel);
        writer.write_image_data(picture.pixels().as_flattened()).map_err(broken)?;
    }
    writer.finish().map_err(broken)?;
    Ok(bytes)
}

fn moved(plane: &Image<f32>, map: &[Option<usize>]) -> Image<f32> {
    let value = |from: &Option<usize>| from.map_or(f32::NAN, |i| plane.pixels()[i]);
    Image::from_pixels(plane.width(), plane.height(), map.iter().map(value).collect())
}
