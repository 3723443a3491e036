//! Elements of a plot as operators of a page.

use super::FONT;
use super::font::Font;
use crate::figure::paint::Paint;
use pdf_writer::types::TextRenderingMode;
use pdf_writer::{Content, Name, Str};
use roxmltree::Node;
use std::collections::BTreeSet;

/// Size of all text, in pixels of the plot.
const TEXT_PX: f32 = 12.0;
/// A quarter of a circle as a cubic: its control points are this part of the radius away, 4/3 (sqrt 2 - 1).
const QUARTER: f32 = 0.552_284_8;

/// A page's content so far, and what it needs.
pub(super) struct Drawing {
    pub(super) content: Content,
    pub(super) font: Font,
    /// In percent.
    pub(super) opacities: BTreeSet<u8>,
}

/// What an opacity is called on the page.
pub(super) fn opacity_name(percent: u8) -> String {
    format!("G{percent}")
}

/// A number of an element.
pub(super) fn number(element: &Node, name: &str) -> Result<f32, String> {
    let text = element.attribute(name);
    let value = text.and_then(|t| t.parse().ok()).filter(|v: &f32| v.is_finite());
    value.ok_or_else(|| format!("{} has no number {name}", element.tag_name().name()))
}

impl Drawing {
    pub(super) fn new(font: Font) -> Self {
        Self { content: Content::new(), font, opacities: BTreeSet::new() }
    }

    /// Draws what is in an element, first things first.
    pub(super) fn children_of(&mut self, parent: Node) -> Result<(), String> {
        parent.children().filter(Node::is_element).try_for_each(|child| self.element(child))
    }

    fn element(&mut self, element: Node) -> Result<(), String> {
        let name = element.tag_name().name();
        let paint = Paint::of(name, element.attribute("class").unwrap_or_default());
        match name {
            "g" => return self.children_of(element),
            // The sheet is in `Paint`; a title shows when a mouse rests on it.
            "style" | "title" => return Ok(()),
            "text" => return self.text(element, &paint),
            _ => {}
        }
        self.content.save_state();
        self.set(&paint);
        match name {
            "line" => {
                let [x1, y1, x2, y2] = numbers(&element, ["x1", "y1", "x2", "y2"])?;
                self.content.move_to(x1, y1).line_to(x2, y2);
            }
            "circle" => self.circle(numbers(&element, ["cx", "cy", "r"])?),
            "polygon" => self.polygon(element.attribute("points").unwrap_or_default())?,
            "path" => self.path(element.attribute("d").unwrap_or_default())?,
            other => return Err(format!("a plot with <{other}> cannot be drawn")),
        }
        match (paint.fill.is_some() && name != "line", paint.stroke.is_some()) {
            (true, true) => self.content.fill_nonzero_and_stroke(),
            (true, false) => self.content.fill_nonzero(),
            (false, true) => self.content.stroke(),
            (false, false) => self.content.end_path(),
        };
        self.content.restore_state();
        Ok(())
    }

    fn set(&mut self, paint: &Paint) {
        if let Some([r, g, b]) = paint.fill.map(unit) {
            self.content.set_fill_rgb(r, g, b);
        }
        if let Some([r, g, b]) = paint.stroke.map(unit) {
            self.content.set_stroke_rgb(r, g, b);
            self.content.set_line_width(paint.width);
        }
        if !paint.dash.is_empty() {
            self.content.set_dash_pattern(paint.dash.iter().copied(), 0.0);
        }
        if paint.opacity < 1.0 {
            let percent = (100.0 * paint.opacity).round() as u8;
            self.opacities.insert(percent);
            self.content.set_parameters(Name(opacity_name(percent).as_bytes()));
        }
    }

    fn circle(&mut self, [x, y, r]: [f32; 3]) {
        let k = QUARTER * r;
        self.content.move_to(x + r, y);
        self.content.cubic_to(x + r, y + k, x + k, y + r, x, y + r);
        self.content.cubic_to(x - k, y + r, x - r, y + k, x - r, y);
        self.content.cubic_to(x - r, y - k, x - k, y - r, x, y - r);
        self.content.cubic_to(x + k, y - r, x + r, y - k, x + r, y).close_path();
    }

    fn polygon(&mut self, points: &str) -> Result<(), String> {
        for (index, point) in points.split_whitespace().enumerate() {
            let xy = point.split_once(',').and_then(|(x, y)| Some((x.parse().ok()?, y.parse().ok()?)));
            let (x, y) = xy.ok_or_else(|| format!("no point: {point}"))?;
            if index == 0 {
                self.content.move_to(x, y)
            } else {
                self.content.line_to(x, y)
            };
        }
        self.content.close_path();
        Ok(())
    }

    /// M, L, H, V and Z, as the plots write them.
    fn path(&mut self, d: &str) -> Result<(), String> {
        let (mut x, mut y) = (0.0, 0.0);
        let starts = d.char_indices().filter(|(_, c)| c.is_ascii_alphabetic()).map(|(at, _)| at);
        let starts: Vec<usize> = starts.chain([d.len()]).collect();
        for part in starts.windows(2).map(|w| &d[w[0]..w[1]]) {
            let (step, rest) = part.split_at(1);
            let values: Result<Vec<f32>, _> = rest.split_whitespace().map(str::parse).collect();
            match (step, values.map_err(|e| format!("{part}: {e}"))?.as_slice()) {
                ("M" | "L", &[to_x, to_y]) => (x, y) = (to_x, to_y),
                ("H", &[to_x]) => x = to_x,
                ("V", &[to_y]) => y = to_y,
                ("Z", []) => {
                    self.content.close_path();
                    continue;
                }
                _ => return Err(format!("a path with {part} cannot be drawn")),
            }
            if step == "M" {
                self.content.move_to(x, y)
            } else {
                self.content.line_to(x, y)
            };
        }
        Ok(())
    }

    fn text(&mut self, element: Node, paint: &Paint) -> Result<(), String> {
        let [x, y] = numbers(&element, ["x", "y"])?;
        let (glyphs, width) = self.font.set(element.text().unwrap_or_default());
        let before = match element.attribute("text-anchor") {
            Some("end") => width,
            Some("middle") => 0.5 * width,
            _ => 0.0,
        };
        let x = x - before * TEXT_PX;
        self.content.save_state();
        self.set(paint);
        // The outline first: it lies under the letters.
        let outline = paint.stroke.map(|_| TextRenderingMode::Stroke);
        for mode in outline.into_iter().chain([TextRenderingMode::Fill]) {
            self.content.begin_text().set_font(FONT, TEXT_PX).set_text_rendering_mode(mode);
            self.content.set_text_matrix([1.0, 0.0, 0.0, -1.0, x, y]).show(Str(&glyphs)).end_text();
        }
        self.content.restore_state();
        Ok(())
    }
}

fn numbers<const N: usize>(element: &Node, names: [&str; N]) -> Result<[f32; N], String> {
    let mut values = [0.0; N];
    for (value, name) in values.iter_mut().zip(names) {
        *value = number(element, name)?;
    }
    Ok(values)
}

fn unit(rgb: [u8; 3]) -> [f32; 3] {
    rgb.map(|c| f32::from(c) / 255.0)
}
