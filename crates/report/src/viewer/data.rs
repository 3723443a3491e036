//! The description that the page's script reads, as JSON.

use super::Planes;
use crate::book::Book;
use crate::picture::{HATCH, Ramp};
use crate::plot::Look;
use crate::trace::Trace;
use crate::{MetricCard, Scorecard};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
struct Description<'a> {
    windows: Vec<Window<'a>>,
    variants: Vec<Variant<'a>>,
    metrics: BTreeMap<&'a str, Metric<'a>>,
    palettes: BTreeMap<&'static str, String>,
    hatch: [[u8; 3]; 2],
    error_limit: f32,
    tile_px: u32,
    planes: &'a BTreeMap<String, usize>,
    beside: Option<&'static str>,
    command: &'a str,
    trace: &'a [Trace],
}

#[derive(Serialize)]
struct Window<'a> {
    scene: &'a str,
    path: &'a str,
    first: u32,
    step: u32,
    frames: u32,
    width: u32,
    height: u32,
    swim_limit: f32,
    cameras: &'a [[f32; 16]],
}

#[derive(Serialize)]
struct Variant<'a> {
    name: &'a str,
    label: &'static str,
    id: String,
    class: String,
}

#[derive(Serialize)]
struct Metric<'a> {
    name: &'a str,
    unit: &'a str,
    definition: &'a str,
    formula: &'a str,
}

/// Everything that the script has to know, safe inside a `<script>` block.
pub(crate) fn describe(card: &Scorecard, book: &Book, planes: &Planes, trace: &[Trace]) -> String {
    let windows = card.windows.iter().enumerate();
    let variant = |(v, of): (usize, &'_ crate::VariantCard)| Variant {
        name: &card.variants[v].name,
        label: of.calibration.label(),
        id: format!("{}/{}", of.name, of.calibration.id()),
        class: Look::of(card, v).class(),
    };
    let hex = |ramp: Ramp| {
        let levels = usize::from(ramp.levels());
        let colours = ramp.palette().into_iter().take(levels);
        colours.map(|[r, g, b]| format!("{r:02x}{g:02x}{b:02x}")).collect::<String>()
    };
    let description = Description {
        windows: windows.map(|(index, w)| window(card, (book, planes), index, w)).collect(),
        variants: card.variants.iter().enumerate().map(variant).collect(),
        metrics: card.metrics.iter().map(|m| (m.id.as_str(), metric(m))).collect(),
        palettes: [("signed", hex(Ramp::Signed)), ("magnitude", hex(Ramp::Magnitude))].into(),
        hatch: HATCH,
        error_limit: book.error_limit,
        tile_px: card.provenance.tile_px,
        planes: &planes.frames,
        beside: planes.beside,
        command: &card.provenance.command,
        trace,
    };
    // Strings and numbers alone: it cannot fail.
    inert(&serde_json::to_string(&description).unwrap_or_default())
}

fn window<'a>(
    card: &'a Scorecard,
    (book, planes): (&Book, &'a Planes),
    index: usize,
    w: &'a crate::WindowCard,
) -> Window<'a> {
    let (width, height) =
        planes.sizes.get(&index).copied().unwrap_or((card.provenance.width, card.provenance.height));
    Window {
        scene: &w.scene,
        path: &w.path,
        first: w.first_frame,
        step: w.step,
        frames: w.frames,
        width,
        height,
        swim_limit: book.swim_limits.get(&index).copied().unwrap_or(1.0),
        cameras: planes.cameras.get(&index).map_or(&[], Vec::as_slice),
    }
}

fn metric(m: &MetricCard) -> Metric<'_> {
    Metric { name: &m.name, unit: &m.unit, definition: &m.definition, formula: &m.formula }
}

/// JSON in which no tag can begin or end: `<` only occurs inside strings, where it may be escaped.
pub(crate) fn inert(json: &str) -> String {
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

#[cfg(test)]
mod tests {
    use super::inert;

    #[test]
    fn no_name_ends_the_block_that_it_stands_in() {
        let name = "</script><!--<script>&amp;";
        let text = inert(&serde_json::to_string(name).expect("a string"));
        assert!(!text.contains(['<', '>', '&']));
        assert_eq!(serde_json::from_str::<String>(&text).expect("still JSON"), name);
    }
}
