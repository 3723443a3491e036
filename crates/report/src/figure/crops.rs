//! Whole pictures in a row with their insets below, as PNG; the insets' numbers as EXR.

use super::Chosen;
use crate::ReportError;
use crate::picture::{png_of_rgb, shade};
use crate::store::{read_variant, scorecard_path};
use std::path::{Path, PathBuf};
use umbrage_frame::{Image, Layer, write_exr};

/// Between pictures, in pixels of the figure.
const GAP: u32 = 8;
/// Around an inset and its place; told apart by colour-blind readers.
const FRAMES: [[u8; 3]; 4] = [[230, 97, 1], [94, 60, 153], [0, 114, 178], [0, 158, 115]];
/// Pixels of a figure: 0.8 GB of colours.
const LARGEST: u64 = 1 << 28;
const PAPER: [u8; 3] = [255; 3];

/// A picture, its name, and the same as a name of a layer.
struct Panel {
    name: String,
    layer: String,
    plane: Image<f32>,
}

/// Truth first, then each variant.
fn panels(chosen: &Chosen) -> Result<Vec<Panel>, ReportError> {
    let truth = chosen.pictures.truth.clone();
    let mut all = vec![Panel { name: "truth".into(), layer: "reference.V".into(), plane: truth }];
    for &v in &chosen.variants {
        let of = &chosen.card.variants[v];
        let name = one_line(&format!("{} ({})", of.name, of.calibration.label()));
        let stem =
            format!("{}-{}", of.name.chars().map(layer_letter).collect::<String>(), of.calibration.id());
        // Names that differ in other letters only, or a variant asked for twice.
        let taken = |layer: &String| all.iter().any(|panel: &Panel| panel.layer == *layer);
        let numbered = std::iter::once(format!("{stem}.V")).chain((2..).map(|n| format!("{stem}-{n}.V")));
        let layer = numbered.into_iter().find(|layer| !taken(layer)).unwrap_or_default();
        all.push(Panel { name, layer, plane: read_variant(chosen.run, chosen.window, v)?.mask });
    }
    Ok(all)
}

/// Dots part layers.
fn layer_letter(c: char) -> char {
    if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' }
}

/// A name in a sentence: no line breaks, nothing that a terminal obeys.
pub(super) fn one_line(name: &str) -> String {
    name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Writes `crops.png` and `crop-N.exr`; returns what they show, and the files of values.
pub(super) fn write(
    chosen: &Chosen,
    (out, put): (&Path, &mut impl FnMut(&str, &[u8]) -> Result<(), ReportError>),
) -> Result<(String, Vec<PathBuf>), ReportError> {
    let panels = panels(chosen)?;
    let crops = &chosen.crops;
    put("crops.png", &png_of_rgb("crops", &sheet(chosen, &panels)?)?)?;
    let mut values = Vec::new();
    for (index, &crop) in crops.iter().enumerate() {
        let layers: Vec<Layer> = panels.iter().map(|p| (p.layer.clone(), cut(&p.plane, crop))).collect();
        let path = out.join(format!("crop-{index}.exr"));
        write_exr(&path, &layers)?;
        values.push(path);
    }
    let names: Vec<&str> = panels.iter().map(|p| p.name.as_str()).collect();
    let w = &chosen.card.windows[chosen.window];
    let places: Vec<String> = crops.iter().map(|[x, y, w, h]| format!("{x},{y} of {w}x{h}")).collect();
    let insets = match places.as_slice() {
        [] => String::new(),
        places => format!(" Insets at pixels {}; their values in crop-N.exr.", places.join("; ")),
    };
    let caption = format!(
        "crops.png: {}, {}, middle frame. Left to right: {}.{insets}\n",
        one_line(&w.scene),
        one_line(&w.path),
        names.join("; "),
    );
    Ok((caption, values))
}

pub(super) fn cut(plane: &Image<f32>, [left, top, width, height]: [u32; 4]) -> Image<f32> {
    Image::from_fn(width, height, |x, y| *plane.at(left + x, top + y))
}

/// Refuses a picture that would fill the memory of a machine.
pub(super) fn check_size(chosen: &Chosen, (columns, rows): (u32, u32)) -> Result<(), ReportError> {
    if u64::from(columns) * u64::from(rows) <= LARGEST {
        return Ok(());
    }
    let reason = format!(
        "a figure of {columns}x{rows} pixels is too large: fewer variants, a smaller --times, or insets that are less tall"
    );
    Err(ReportError::Request { path: scorecard_path(chosen.run), reason })
}

fn sheet(chosen: &Chosen, panels: &[Panel]) -> Result<Image<[u8; 3]>, ReportError> {
    let (crops, times) = (&chosen.crops, chosen.times);
    let (width, height) = (panels[0].plane.width() * times, panels[0].plane.height() * times);
    // Insets share a panel's width.
    let count = crops.len().max(1) as u32;
    let inset = width.saturating_sub((count - 1) * GAP) / count;
    if inset == 0 {
        let reason = format!("{count} insets do not fit under a picture of {width} pixels");
        return Err(ReportError::Request { path: scorecard_path(chosen.run), reason });
    }
    let tall = crops.iter().map(|c| inset * c[3] / c[2]).max().unwrap_or(0);
    let rows = if tall > 0 { height + GAP + tall } else { height };
    let columns = panels.len() as u32 * (width + GAP) - GAP;
    check_size(chosen, (columns, rows))?;
    let mut sheet = Image::filled(columns, rows, PAPER);
    for (index, panel) in panels.iter().enumerate() {
        let left = index as u32 * (width + GAP);
        let whole = [0, 0, panel.plane.width(), panel.plane.height()];
        draw(&mut sheet, &panel.plane, whole, [left, 0, width, height]);
        for (i, &crop) in crops.iter().enumerate() {
            let colour = FRAMES[i % FRAMES.len()];
            frame(
                &mut sheet,
                [left + crop[0] * times, crop[1] * times, crop[2] * times, crop[3] * times],
                colour,
            );
            let place = [left + i as u32 * (inset + GAP), height + GAP, inset, inset * crop[3] / crop[2]];
            draw(&mut sheet, &panel.plane, crop, place);
            frame(&mut sheet, place, colour);
        }
    }
    Ok(sheet)
}

/// Draws a part of a plane into a rectangle, by nearest pixels.
fn draw(sheet: &mut Image<[u8; 3]>, plane: &Image<f32>, from: [u32; 4], to: [u32; 4]) {
    for y in 0..to[3] {
        for x in 0..to[2] {
            let (column, row) = (from[0] + x * from[2] / to[2], from[1] + y * from[3] / to[3]);
            set(sheet, to[0] + x, to[1] + y, shade(*plane.at(column, row), column, row));
        }
    }
}

/// Two pixels along the edge of a rectangle.
fn frame(sheet: &mut Image<[u8; 3]>, [left, top, width, height]: [u32; 4], colour: [u8; 3]) {
    for y in 0..height {
        for x in 0..width {
            if x < 2 || y < 2 || x + 2 >= width || y + 2 >= height {
                set(sheet, left + x, top + y, colour);
            }
        }
    }
}

fn set(sheet: &mut Image<[u8; 3]>, x: u32, y: u32, colour: [u8; 3]) {
    let at = (y * sheet.width() + x) as usize;
    sheet.pixels_mut()[at] = colour;
}
