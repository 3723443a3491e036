//! The page's plots as files of their own: colours of the light page, names beside them.

use super::Chosen;
use crate::plot::{Look, pareto, per_frame};
use crate::words::full_name;
use maud::html;

/// As in the page's style sheet, for paper.
const STYLE: &str = "text{font:12px Helvetica,Arial,sans-serif;fill:#1c1d21}.tick,.axis{fill:#656871}.grid{stroke:#dedcd6}\
.line{fill:none;stroke:var(--c);stroke-width:1.8}.line.printed{stroke-dasharray:4 3}.mark{fill:var(--c);stroke:var(--c)}\
.mark.printed{fill:#fff}.band{fill:var(--c);fill-opacity:.13}.whisker{stroke:var(--c)}.frontier{fill:none;stroke:#656871;stroke-dasharray:2 3}\
.label{paint-order:stroke;stroke:#fff;stroke-width:4px}";
/// `--c0` to `--c7`.
const COLOURS: [&str; 8] =
    ["#1d4f91", "#c8501e", "#138468", "#b5548f", "#a57c00", "#3b98cf", "#6a6d75", "#7a3fb0"];
const LINE: f64 = 18.0;

/// Name and text of each plot that there is data for.
pub(super) fn all(chosen: &Chosen) -> Vec<(String, String)> {
    let plots = [("cost.svg", pareto(chosen.card)), ("swimming.svg", per_frame(chosen.card, chosen.window))];
    let alone = |(name, plot): (&str, Option<maud::Markup>)| {
        Some((name.to_string(), alone(chosen, &plot?.into_string())?))
    };
    plots.into_iter().filter_map(alone).collect()
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
    // Not every reader of SVG knows variables: colours are written out.
    let colours: String = COLOURS
        .iter()
        .enumerate()
        .map(|(i, c)| STYLE_OF.replace("@i", &i.to_string()).replace("@c", c))
        .collect();
    Some(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {tall}\" width=\"{width}\" height=\"{tall}\">\
         <style>{STYLE}{colours}</style>{content}{legend}</svg>\n"
    ))
}

/// What `var(--c)` does, colour by colour.
const STYLE_OF: &str = ".c@i{--c:@c}.line.c@i,.whisker.c@i{stroke:@c}.mark.c@i{stroke:@c}.mark.matched.c@i{fill:@c}.band.c@i{fill:@c}";
