//! From a stored run to its pages.

use crate::book::{BESIDE, data_uri, make_book};
use crate::error::write_whole;
use crate::gate::GateCard;
use crate::page::{Sources, page};
use crate::store::{read_index, scorecard_path};
use crate::tables::{junit, scores_csv, summary};
use crate::trace::traces;
use crate::viewer::{describe, pack};
use crate::{ReportError, Scorecard};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where the pictures of the page go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Into the page: one file that can be mailed.
    #[default]
    SingleFile,
    /// Beside the page, into `index_files/`: for runs too large for one file.
    Folder,
}

/// What was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The page.
    pub index: PathBuf,
    /// Its size in bytes.
    pub index_bytes: usize,
    /// Every file: the page first, then the tables.
    pub files: Vec<PathBuf>,
    /// What the user should know: a page above 10 MB, a run without pictures.
    pub warnings: Vec<String>,
}

/// Above this browsers and mail programs begin to complain.
const LARGE_BYTES: usize = 10_000_000;

/// Pictures of what regressed, as the page's images name them. One that is gone is left out: its numbers are there.
fn crops_of(run: &Path, gate: Option<&GateCard>, layout: Layout) -> BTreeMap<String, String> {
    let files = gate.iter().flat_map(|g| &g.cases).filter_map(|c| c.crop.clone());
    let source = |file: &String| match layout {
        Layout::Folder => Some(file.clone()),
        Layout::SingleFile => std::fs::read(run.join(file)).ok().map(|png| data_uri(&png)),
    };
    files.filter_map(|file| source(&file).map(|s| (file, s))).collect()
}

/// Makes `index.html`, `scores.csv`, `summary.md` and `junit.xml` from a stored run. Can be done
/// again at any time; existing pages are replaced.
///
/// # Errors
/// A run without a readable scorecard, a stored picture that cannot be read, or a page that cannot
/// be written.
pub fn write_report(run: &Path, layout: Layout) -> Result<Written, ReportError> {
    let card = Scorecard::load(&scorecard_path(run))?;
    let gate = GateCard::load(run)?;
    let gate = gate.as_ref();
    let pictures = read_index(run)?;
    let book = make_book(run, &card, &pictures, layout)?;
    let planes = pack(run, &card, &pictures, (layout, BESIDE))?;
    // Sums that cannot be read cost the page its worst places, not its numbers.
    let mut warnings = Vec::new();
    let traces = traces(run, &card).unwrap_or_else(|error| {
        warnings.push(format!("no worst places: {error}"));
        Vec::new()
    });
    let description = describe(&card, &book, &planes, &traces);
    let html = page(Sources {
        card: &card,
        book: &book,
        gate,
        crops: &crops_of(run, gate, layout),
        planes: &planes,
        description: &description,
    });
    if pictures.windows.is_empty() {
        warnings.push("the run has no pictures: the page shows numbers only".to_string());
    }
    if html.len() > LARGE_BYTES {
        let size = html.len() as f64 / 1e6;
        warnings
            .push(format!("index.html has {size:.1} MB; write its pictures beside it to make it smaller"));
    }
    let index_bytes = html.len();
    let files = [
        ("index.html", html),
        ("scores.csv", scores_csv(&card)),
        ("summary.md", summary(&card, gate)),
        ("junit.xml", junit(&card, gate)),
    ];
    let mut written = Vec::new();
    for (name, text) in files {
        let path = run.join(name);
        write_whole(&path, text.as_bytes())?;
        written.push(path);
    }
    Ok(Written { index: run.join("index.html"), index_bytes, files: written, warnings })
}
