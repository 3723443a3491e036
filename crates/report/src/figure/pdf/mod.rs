//! A plot as a PDF of one page: the same lines, shapes and letters as its SVG, none of them pixels.
//!
//! Deliberately absent: SVG in general. What is not in our plots is an error and not left out.

mod draw;
mod font;

use draw::Drawing;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use font::{Font, FontRefs};
use pdf_writer::{Filter, Finish as _, Name, Pdf, Rect, Ref, TextStr};
use roxmltree::Document;
use std::io::Write as _;

/// A pixel of a style sheet is 1/96 inch, a unit of PDF 1/72.
const POINTS_PER_PX: f32 = 0.75;
const FONT: Name = Name(b"F");
const FONT_REFS: FontRefs = FontRefs {
    font: Ref::new(5),
    descendant: Ref::new(6),
    descriptor: Ref::new(7),
    file: Ref::new(8),
    unicode: Ref::new(9),
};
/// Opacities come after everything else, for there may be any number of them.
const FIRST_OPACITY: i32 = 11;

/// The plot of an SVG file that `plots` made; the same bytes each time, without a date.
pub(super) fn pdf_of_plot(svg: &str, title: &str) -> Result<Vec<u8>, String> {
    let document = Document::parse(svg).map_err(|e| e.to_string())?;
    let size = |name| draw::number(&document.root_element(), name);
    let (width, height) = (size("width")? * POINTS_PER_PX, size("height")? * POINTS_PER_PX);
    let mut drawing = Drawing::new(Font::new()?);
    // SVG counts downwards from the top.
    drawing.content.transform([POINTS_PER_PX, 0.0, 0.0, -POINTS_PER_PX, 0.0, height]);
    drawing.children_of(document.root_element())?;

    let [catalog, pages, page, content, info] = [1, 2, 3, 4, 10].map(Ref::new);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.document_info(info).title(TextStr(title)).creator(TextStr("umbrage"));
    pdf.pages(pages).kids([page]).count(1);
    let opacity = |index: usize| Ref::new(FIRST_OPACITY + index as i32);
    let mut sheet = pdf.page(page);
    sheet.parent(pages).media_box(Rect::new(0.0, 0.0, width, height)).contents(content);
    let mut resources = sheet.resources();
    resources.fonts().pair(FONT, FONT_REFS.font);
    let mut states = resources.ext_g_states();
    for (index, &percent) in drawing.opacities.iter().enumerate() {
        states.pair(Name(draw::opacity_name(percent).as_bytes()), opacity(index));
    }
    states.finish();
    resources.finish();
    sheet.finish();
    for (index, &percent) in drawing.opacities.iter().enumerate() {
        pdf.ext_graphics(opacity(index)).non_stroking_alpha(f32::from(percent) / 100.0);
    }
    drawing.font.write(&mut pdf, &FONT_REFS);
    let packed = deflated(&drawing.content.finish());
    pdf.stream(content, &packed).filter(Filter::FlateDecode);
    Ok(pdf.finish())
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    // Writing to memory cannot fail.
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    const OPEN: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"96\" height=\"48\">";

    #[test]
    fn a_page_is_as_large_as_its_plot_and_the_same_each_time() {
        let svg = format!(
            "{OPEN}<line class=\"grid\" x1=\"1\" y1=\"2\" x2=\"3\" y2=\"4\"/><text x=\"0\" y=\"9\">\u{3bb} \u{4e2d}</text></svg>"
        );
        let pdf = pdf_of_plot(&svg, "a plot").expect("drawn");
        assert!(pdf.starts_with(b"%PDF-1.7"));
        let text = String::from_utf8_lossy(&pdf);
        assert!(text.contains("/MediaBox [0 0 72 36]") && text.contains("/Count 1"), "{text}");
        assert!(text.contains("/FontFile2 8 0 R"), "the font is in the file");
        assert_eq!(pdf, pdf_of_plot(&svg, "a plot").expect("drawn"));
    }

    #[test]
    fn what_cannot_be_drawn_is_an_error() {
        for bad in ["<ellipse/>", "<path d=\"M0 0C1 1 2 2 3 3\"/>", "<line x1=\"a\"/>", "<circle cx=\"1\"/>"]
        {
            let svg = format!("{OPEN}{bad}</svg>");
            assert!(pdf_of_plot(&svg, "").is_err(), "{bad}");
        }
    }
}
