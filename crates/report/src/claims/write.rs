//! From cards and crops to files.

use super::markdown::markdown_of;
use super::page::page;
use super::{ClaimsCard, Crop};
use crate::ReportError;
use crate::error::write_whole;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Folder of the crops, beside the pages.
const CROPS: &str = "claims";

/// Writes `index.html`, `claims.md`, `claims.json` and `claims/*.png`; fills in the card's crops. Returns
/// the page.
///
/// # Errors
/// A number that is not finite, or a file that cannot be written.
pub fn write_claims(
    folder: &Path,
    card: &mut ClaimsCard,
    crops: &BTreeMap<String, Crop>,
) -> Result<PathBuf, ReportError> {
    check_finite(card)?;
    let pngs = write_crops(folder, card, crops)?;
    let json = serde_json::to_string_pretty(&card).map_err(|e| ReportError::Contradiction(e.to_string()))?;
    write_whole(&folder.join("claims.json"), format!("{json}\n").as_bytes())?;
    write_whole(&folder.join("claims.md"), markdown_of(card).as_bytes())?;
    let index = folder.join("index.html");
    write_whole(&index, page(card, &pngs).as_bytes())?;
    Ok(index)
}

/// Copies the table and the crops of a run to where they are committed.
///
/// # Errors
/// A file that cannot be read or written.
pub fn publish_claims(run: &Path, reports: &Path) -> Result<(), ReportError> {
    let into = reports.join(CROPS);
    std::fs::create_dir_all(&into).map_err(ReportError::at(&into))?;
    let copy = |from: &Path, to: &Path| -> Result<(), ReportError> {
        let bytes = std::fs::read(from).map_err(ReportError::at(from))?;
        write_whole(to, &bytes)
    };
    copy(&run.join("claims.md"), &reports.join("claims.md"))?;
    let from = run.join(CROPS);
    for entry in std::fs::read_dir(&from).map_err(ReportError::at(&from))?.flatten() {
        copy(&entry.path(), &into.join(entry.file_name()))?;
    }
    Ok(())
}

/// Every crop as a file; and its bytes, for the page.
fn write_crops(
    folder: &Path,
    card: &mut ClaimsCard,
    crops: &BTreeMap<String, Crop>,
) -> Result<BTreeMap<String, Vec<u8>>, ReportError> {
    let into = folder.join(CROPS);
    std::fs::create_dir_all(&into).map_err(ReportError::at(&into))?;
    let mut pngs = BTreeMap::new();
    for claim in &mut card.claims {
        let Some(crop) = crops.get(&claim.id) else { continue };
        let name = file_name(&claim.id);
        let png = crop.png(&claim.id)?;
        write_whole(&into.join(&name), &png)?;
        claim.crop = Some(format!("{CROPS}/{name}"));
        claim.crop_caption = Some(crop.words());
        pngs.insert(claim.id.clone(), png);
    }
    Ok(pngs)
}

/// "C7" becomes "C07.png", so that files sort as claims do.
fn file_name(id: &str) -> String {
    let safe: String = id.chars().filter(char::is_ascii_alphanumeric).take(20).collect();
    match safe.strip_prefix('C').and_then(|n| n.parse::<u32>().ok()) {
        Some(number) => format!("C{number:02}.png"),
        None => format!("{safe}.png"),
    }
}

/// JSON has no word for NaN, and a verdict from one is none.
fn check_finite(card: &ClaimsCard) -> Result<(), ReportError> {
    for claim in &card.claims {
        for part in &claim.parts {
            let scores = [part.effect, part.value_a, part.value_b];
            let all = scores.into_iter().flatten().chain(part.per_place.iter().map(|p| p.effect));
            if all.flat_map(|s| [s.value, s.low, s.high]).any(|v| !v.is_finite()) {
                return Err(ReportError::NotFinite { place: claim.id.clone(), metric: part.number.clone() });
            }
        }
    }
    Ok(())
}
