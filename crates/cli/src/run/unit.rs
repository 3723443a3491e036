//! Results on disk, by content: a variant in a window that was measured before is not measured
//! again, and a killed run takes up where it was. One folder a unit, written under a temporary
//! name and renamed; a damaged one is measured again.

use super::measure::{Measured, Numbers};
use super::window::Window;
use crate::error::CliError;
use crate::suite::Sampling;
use std::path::{Path, PathBuf};
use umbrage_frame::{Image, Layer, read_exr, write_exr};
use umbrage_report::{CELLS, CellMaps, VariantPictures};
use umbrage_shadows::{Renderer, Seeding, VariantId};

/// A folder of measured units that may be shared by processes.
pub(crate) struct Units {
    folder: PathBuf,
}

/// Names of the files of a unit.
const NUMBERS: &str = "numbers.json";
const PICTURES: &str = "pictures.exr";
const TILES: &str = "tiles.exr";
const CHECKSUM: &str = "checksum";

/// The content that a unit follows from: truth, views (those before the window too), the recorded passes with their shaders and
/// constants, adapter and driver, seeds, tool version.
pub(crate) fn key(
    window: &Window,
    variant: VariantId,
    (renderer, sampling, adapter): (&mut Renderer<'_>, &Sampling, &str),
) -> Result<String, CliError> {
    let mut hasher = blake3::Hasher::new();
    let mut add = |part: &str| {
        hasher.update(&(part.len() as u64).to_le_bytes());
        hasher.update(part.as_bytes());
    };
    add(concat!("umbrage unit 2 ", env!("CARGO_PKG_VERSION")));
    add(adapter);
    add(&window.truth_key);
    add(&variant.name());
    add(&format!(
        "{} {} {:?} {} {:?}",
        sampling.seeds, sampling.first_seed, sampling.size, window.first, sampling.plant
    ));
    for (frame, (view, light)) in window.frames.iter().enumerate() {
        add(&format!("{view:?} {light:?} {:?}", window.past(frame)));
    }
    renderer.set_past(window.past(0));
    for seeding in [Seeding::Fresh, Seeding::Frozen, Seeding::Animated] {
        let (view, light) = &window.frames[0];
        add(&format!("{:?}", renderer.recording(variant, (view, light), (seeding, [0, 0]))?));
    }
    Ok(hasher.finalize().to_hex().to_string())
}

/// Hash of the program itself: whatever else a result follows from (metrics, tile side, bootstrap)
/// is in there, so that a rebuilt program never takes an older one's results for its own.
pub(crate) fn program_hash() -> String {
    let bytes = std::env::current_exe().and_then(std::fs::read);
    bytes.map_or_else(|_| env!("CARGO_PKG_VERSION").into(), |b| blake3::hash(&b).to_hex().to_string())
}

impl Units {
    /// Opens the folder and clears away what killed runs left behind.
    pub(crate) fn open(folder: &Path) -> Result<Self, CliError> {
        std::fs::create_dir_all(folder).map_err(CliError::file(folder))?;
        let units = Self { folder: folder.into() };
        let entries = std::fs::read_dir(folder).map_err(CliError::file(folder))?;
        for entry in entries.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let old = entry
                .metadata()
                .and_then(|m| m.modified())
                .is_ok_and(|t| t.elapsed().is_ok_and(|age| age > std::time::Duration::from_secs(24 * 3600)));
            if name.starts_with("tmp-") && old {
                let _ = std::fs::remove_dir_all(entry.path());
            }
        }
        Ok(units)
    }

    /// Takes away a unit that is there but not whole, so that it can be stored again; whether there
    /// was one.
    pub(crate) fn discard_damaged(&self, key: &str) -> bool {
        let path = self.path(key);
        path.exists() && self.read(key).is_none() && std::fs::remove_dir_all(path).is_ok()
    }

    /// A unit that is there and whole.
    pub(crate) fn read(&self, key: &str) -> Option<Measured> {
        let folder = self.path(key);
        let text = std::fs::read(folder.join(NUMBERS)).ok()?;
        let stored = std::fs::read_to_string(folder.join(CHECKSUM)).ok()?;
        if stored.trim() != checksum(&folder)? {
            return None;
        }
        let numbers: Numbers = serde_json::from_slice(&text).ok()?;
        let [mut layers, mut tiles] =
            [read_exr(&folder.join(PICTURES)).ok()?, read_exr(&folder.join(TILES)).ok()?];
        let cells = CellMaps {
            pixels: CELLS.iter().map_while(|id| take_layer(&mut layers, &cell_name(id))).collect(),
            tiles: CELLS.iter().map_while(|id| take_layer(&mut tiles, &cell_name(id))).collect(),
        };
        let mut take = |name: &str| take_layer(&mut layers, name);
        let (mask, error, swim) = (take("visibility.V")?, take("error.V")?, take("swim.V"));
        let series = (0..).map_while(|t| take(&frame_name(t))).collect();
        let pictures = VariantPictures { mask, error, swim, series, cells };
        Some(Measured { numbers, pictures })
    }

    /// Stores a unit. A disk that does not take it loses nothing but time: the run goes on.
    pub(crate) fn write(&self, key: &str, unit: &Measured) {
        let temporary = self.folder.join(format!("tmp-{}-{}", std::process::id(), &key[..16]));
        let stored = self.fill(&temporary, unit).and_then(|()| {
            let path = self.path(key);
            std::fs::create_dir_all(path.parent()?).ok()?;
            // Another process may have been faster: its unit holds the same.
            std::fs::rename(&temporary, &path).ok()
        });
        if stored.is_none() {
            let _ = std::fs::remove_dir_all(&temporary);
        }
    }

    fn fill(&self, folder: &Path, unit: &Measured) -> Option<()> {
        std::fs::create_dir_all(folder).ok()?;
        let text = serde_json::to_vec(&unit.numbers).ok()?;
        std::fs::write(folder.join(NUMBERS), &text).ok()?;
        let VariantPictures { mask, error, swim, series, cells } = &unit.pictures;
        let mut layers =
            vec![("visibility.V".to_string(), mask.clone()), ("error.V".to_string(), error.clone())];
        layers.extend(swim.clone().map(|swim| ("swim.V".to_string(), swim)));
        layers.extend(series.iter().enumerate().map(|(t, frame)| (frame_name(t), frame.clone())));
        let named = |maps: &[Image<f32>]| {
            CELLS.iter().zip(maps).map(|(id, map)| (cell_name(id), map.clone())).collect::<Vec<_>>()
        };
        layers.extend(named(&cells.pixels));
        write_exr(&folder.join(PICTURES), &layers).ok()?;
        write_exr(&folder.join(TILES), &named(&cells.tiles)).ok()?;
        std::fs::write(folder.join(CHECKSUM), checksum(folder)?).ok()
    }

    fn path(&self, key: &str) -> PathBuf {
        self.folder.join(&key[..2]).join(&key[2..])
    }
}

/// The layer of a frame of the series.
fn frame_name(frame: usize) -> String {
    format!("t{frame:04}.V")
}

/// Over all files of a unit; none where one is missing.
fn checksum(folder: &Path) -> Option<String> {
    let mut hasher = blake3::Hasher::new();
    for name in [NUMBERS, PICTURES, TILES] {
        let bytes = std::fs::read(folder.join(name)).ok()?;
        hasher.update(&(bytes.len() as u64).to_le_bytes()).update(&bytes);
    }
    Some(hasher.finalize().to_hex().to_string())
}

fn take_layer(layers: &mut Vec<Layer>, name: &str) -> Option<Image<f32>> {
    let place = layers.iter().position(|l| l.0 == name)?;
    Some(layers.swap_remove(place).1)
}

fn cell_name(id: &str) -> String {
    format!("{id}.V")
}
