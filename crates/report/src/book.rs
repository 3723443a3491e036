//! The pictures of a page, made from the stored planes one at a time.

use crate::error::write_whole;
use crate::picture::{Ramp, Scale, png_of, png_of_bar, png_of_beauty, round_up};
use crate::store::{PictureIndex, StoredVariant, read_variant, read_window};
use crate::{Layout, ReportError, Scorecard};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Slot {
    Truth,
    Beauty,
    Mask(usize),
    Error(usize),
    Swim(usize),
}

/// A picture, as the page refers to it.
#[derive(Clone, Debug)]
pub(crate) struct Shown {
    /// The file itself as a data URI, or its name beside the page.
    pub(crate) source: String,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// All pictures of a run, and the limits of their colours.
#[derive(Debug, Default)]
pub(crate) struct Book {
    shown: BTreeMap<(usize, Slot), Shown>,
    /// One for the whole run, so that a colour means the same everywhere.
    pub(crate) error_limit: f32,
    /// One per window: swimming differs by orders of magnitude between paths.
    pub(crate) swim_limits: BTreeMap<usize, f32>,
    /// Colour bars of shadow, error and swim.
    pub(crate) bars: [String; 3],
}

impl Book {
    /// The picture of a window, where it was stored.
    pub(crate) fn shown(&self, window: usize, slot: Slot) -> Option<&Shown> {
        self.shown.get(&(window, slot))
    }

    /// Whether a window has any picture.
    pub(crate) fn has(&self, window: usize) -> bool {
        self.shown.range((window, Slot::Truth)..(window + 1, Slot::Truth)).next().is_some()
    }
}

/// Where pictures go.
struct Printer<'a> {
    /// The folder beside the page, and its name.
    beside: Option<(PathBuf, &'a str)>,
}

/// The folder beside a page.
pub(crate) const BESIDE: &str = "index_files";

/// Makes every picture of a run.
pub(crate) fn make_book(
    run: &Path,
    card: &Scorecard,
    index: &PictureIndex,
    layout: Layout,
) -> Result<Book, ReportError> {
    let printer = Printer::new(run, layout)?;
    let mut book = Book { error_limit: error_limit(&index.variants), ..Book::default() };
    for (bar, ramp) in book.bars.iter_mut().zip([Ramp::Grey, Ramp::Signed, Ramp::Magnitude]) {
        *bar = data_uri(&png_of_bar(ramp)?);
    }
    for &(window, _) in index.windows.iter().filter(|w| w.0 < card.windows.len()) {
        let pictures = read_window(run, window)?;
        let size = (pictures.truth.width(), pictures.truth.height());
        let name = format!("window-{window:02}-truth");
        let truth = printer.print(&name, png_of(&name, &pictures.truth, Scale::SHADOW)?, size)?;
        book.shown.insert((window, Slot::Truth), truth);
        if let Some(beauty) = &pictures.beauty {
            let name = format!("window-{window:02}-beauty");
            let shown = printer.print(&name, png_of_beauty(&name, beauty)?, size)?;
            book.shown.insert((window, Slot::Beauty), shown);
        }
    }
    for window in 0..card.windows.len() {
        let of_window: Vec<_> = index.variants.iter().filter(|v| v.window == window).cloned().collect();
        book.swim_limits.insert(window, swim_limit(&of_window));
    }
    for stored in index.variants.iter().filter(|v| v.window < card.windows.len()) {
        book.add_variant(run, &printer, stored)?;
    }
    Ok(book)
}

impl Book {
    fn add_variant(
        &mut self,
        run: &Path,
        printer: &Printer,
        stored: &StoredVariant,
    ) -> Result<(), ReportError> {
        let (window, variant) = (stored.window, stored.variant);
        let pictures = read_variant(run, window, variant)?;
        let swim_limit = self.swim_limits.get(&window).copied().unwrap_or(1.0);
        let planes = [
            (Slot::Mask(variant), "shadow", Some(&pictures.mask), Scale::SHADOW),
            (Slot::Error(variant), "error", Some(&pictures.error), Scale::error(self.error_limit)),
            (Slot::Swim(variant), "swim", pictures.swim.as_ref(), Scale::magnitude(swim_limit)),
        ];
        for (slot, kind, plane, scale) in planes {
            let Some(plane) = plane else { continue };
            let name = format!("window-{window:02}-variant-{variant:02}-{kind}");
            let png = png_of(&name, plane, scale)?;
            self.shown.insert((window, slot), printer.print(&name, png, (plane.width(), plane.height()))?);
        }
        Ok(())
    }
}

impl<'a> Printer<'a> {
    fn new(run: &Path, layout: Layout) -> Result<Self, ReportError> {
        if layout == Layout::SingleFile {
            return Ok(Self { beside: None });
        }
        let folder = run.join(BESIDE);
        std::fs::create_dir_all(&folder).map_err(ReportError::at(&folder))?;
        Ok(Self { beside: Some((folder, BESIDE)) })
    }

    fn print(&self, name: &str, png: Vec<u8>, (width, height): (u32, u32)) -> Result<Shown, ReportError> {
        let source = match &self.beside {
            None => data_uri(&png),
            Some((folder, link)) => {
                write_whole(&folder.join(format!("{name}.png")), &png)?;
                format!("{link}/{name}.png")
            }
        };
        Ok(Shown { source, width, height })
    }
}

/// A picture inside the page.
pub(crate) fn data_uri(png: &[u8]) -> String {
    format!("data:image/png;base64,{}", base64::encode(png))
}

/// From the middle one of all pictures: a hard shadow is wrong by all of the light, and would leave
/// the others pale. What lies beyond is clamped.
fn error_limit(variants: &[StoredVariant]) -> f32 {
    let mut limits: Vec<f32> = variants.iter().map(|v| v.error_p995).collect();
    limits.sort_by(f32::total_cmp);
    round_up(limits.get(limits.len() / 2).copied().unwrap_or(0.0)).min(1.0)
}

/// From the one that swims most: half of the variants may not swim at all.
fn swim_limit(variants: &[StoredVariant]) -> f32 {
    round_up(variants.iter().filter_map(|v| v.swim_p995).fold(0.0, f32::max))
}
