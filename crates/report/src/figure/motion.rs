//! A path as an animation: with every surface point held where it is, and as its cameras see it.

use super::Chosen;
use super::crops::{cut, one_line};
use crate::ReportError;
use crate::picture::shade;
use crate::store::{read_series, read_truth_series};
use crate::words::full_name;
use glam::{Mat4, Vec3};
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
    put("path-follow.png", &animation(frames, zoom, follow)?)?;
    put("path-camera.png", &animation(frames, chosen.times, camera)?)?;
    let names: Vec<String> = variants.iter().map(|&v| one_line(&full_name(&chosen.card.variants[v]))).collect();
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
    frames: usize,
    times: u32,
    frame: impl Fn(usize) -> Vec<Image<f32>>,
) -> Result<Vec<u8>, ReportError> {
    let broken = |e: png::EncodingError| ReportError::Picture { name: "path".into(), reason: e.to_string() };
    let first = frame(0);
    let (width, height) = (first[0].width() * times, first[0].height() * times);
    let columns = first.len() as u32 * (width + GAP) - GAP;
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

/// For each frame and pixel, the point of the middle frame that it shows.
fn maps(depth: &Image<f32>, cameras: &[[f32; 16]]) -> Vec<Vec<Option<usize>>> {
    let cameras: Vec<Mat4> = cameras.iter().map(Mat4::from_cols_array).collect();
    let world = positions(depth, cameras[cameras.len() / 2]);
    cameras.iter().map(|camera| map(depth, camera, &world)).collect()
}

fn positions(depth: &Image<f32>, camera: Mat4) -> Vec<Option<Vec3>> {
    let inverse = camera.inverse();
    let (width, height) = (depth.width(), depth.height());
    let position = |(i, &d): (usize, &f32)| {
        let (x, y) = ((i as u32 % width) as f32 + 0.5, (i as u32 / width) as f32 + 0.5);
        let at = inverse
            * glam::vec4((2.0 * x / width as f32 - 1.0) * d, (1.0 - 2.0 * y / height as f32) * d, 0.0, d);
        // In perspective the depth is clip w; w of a world point is 1, which settles clip z.
        let z = (1.0 - at.w) / inverse.z_axis.w;
        d.is_finite().then(|| (at + z * inverse.z_axis).truncate())
    };
    depth.pixels().iter().enumerate().map(position).collect()
}

fn map(depth: &Image<f32>, camera: &Mat4, world: &[Option<Vec3>]) -> Vec<Option<usize>> {
    let (width, height) = (depth.width(), depth.height());
    let mut nearest = vec![(f32::INFINITY, None); world.len()];
    for (point, position) in world.iter().enumerate() {
        let Some(position) = position else { continue };
        let clip = *camera * position.extend(1.0);
        let (x, y) =
            ((0.5 + 0.5 * clip.x / clip.w) * width as f32, (0.5 - 0.5 * clip.y / clip.w) * height as f32);
        if clip.w > 0.0 && x >= 0.0 && y >= 0.0 && x < width as f32 && y < height as f32 {
            let at = y as usize * width as usize + x as usize;
            if clip.w < nearest[at].0 {
                nearest[at] = (clip.w, Some(point));
            }
        }
    }
    nearest.into_iter().map(|(_, point)| point).collect()
}

fn moved(plane: &Image<f32>, map: &[Option<usize>]) -> Image<f32> {
    let value = |from: &Option<usize>| from.map_or(f32::NAN, |i| plane.pixels()[i]);
    Image::from_pixels(plane.width(), plane.height(), map.iter().map(value).collect())
}
