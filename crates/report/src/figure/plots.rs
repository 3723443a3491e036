//! The page's plots as files of their own, SVG and PDF: colours of the light page, names beside them.

use super::Chosen;
use super::paint::style_sheet;
use super::pdf::pdf_of_plot;
use crate::plot::{Look, pareto, per_frame};
use crate::tables::legal_xml;
use crate::words::full_name;
use crate::{ReportError, Scorecard};
use maud::{Markup, html};

const LINE: f64 = 18.0;

/// Writes each plot that there is data for.
pub(super) fn write(
    chosen: &Chosen,
    put: &mut impl FnMut(&str, &[u8]) -> Result<(), ReportError>,
) -> Result<(), ReportError> {
    let card = &shown(chosen);
    let window = &card.windows[chosen.window];
    let swimming = format!("SWIMMING per frame: {}, {}", window.scene, window.path);
    let plots = [
        ("cost", "Error against cost".to_string(), pareto(card)),
        ("swimming", swimming, per_frame(card, chosen.window)),
    ];
    for (name, title, plot) in plots {
        // A plot where nothing moves is a sentence without a drawing.
        let Some(svg) = plot.and_then(|plot: Markup| alone(chosen, &plot.into_string())) else { continue };
        put(&format!("{name}.svg"), svg.as_bytes())?;
        let broken = |reason| ReportError::Picture { name: format!("{name}.pdf"), reason };
        put(&format!("{name}.pdf"), &pdf_of_plot(&svg, &title).map_err(broken)?)?;
    }
    Ok(())
}

/// The card with results of the chosen variants alone; every variant keeps its number, and with it its colour.
fn shown(chosen: &Chosen) -> Scorecard {
    let mut card = chosen.card.clone();
    card.results.retain(|r| chosen.variants.contains(&r.variant));
    card.overall.retain(|o| chosen.variants.contains(&o.variant));
    card
}

/// The drawing of a plot as a file of its own, with the names of the variants under it.
fn alone(chosen: &Chosen, markup: &str) -> Option<String> {
    let (_, from) = markup.split_once("<svg")?;
    let (drawing, _) = from.split_once("</svg>")?;
    let (attributes, content) = drawing.split_once('>')?;
    let size = attributes.split("viewBox=\"0 0 ").nth(1)?.split('"').next()?;
    let (width, height) = size.split_once(' ')?;
    let (width, height): (f64, f64) = (width.parse().ok()?, height.parse().ok()?);
    let used = |v: &usize| content.contains(&Look::of(chosen.card, *v).class());
    let names: Vec<usize> = (0..chosen.card.variants.len()).filter(used).collect();
    let tall = height + LINE * (names.len().div_ceil(3) as f64 + 0.5);
    let legend = html! {
        @for (i, &v) in names.iter().enumerate() {
            @let (x, y) = (20.0 + (i % 3) as f64 * width / 3.0, height + LINE * (1.0 + (i / 3) as f64));
            line class={ "line " (Look::of(chosen.card, v).class()) } x1=(x) x2=(x + 26.0) y1=(y - 4.0) y2=(y - 4.0) {}
            (Look::of(chosen.card, v).marker(x + 13.0, y - 4.0, 4.0))
            text x=(x + 34.0) y=(y) { (full_name(&chosen.card.variants[v])) }
        }
    }
    .into_string();
    let style = style_sheet();
    // A browser forgives a page what an XML file must not have.
    Some(legal_xml(&format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {tall}\" width=\"{width}\" height=\"{tall}\">\
         <style>{style}</style>{content}{legend}</svg>\n"
    )))
}
