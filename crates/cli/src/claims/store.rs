//! What was measured, on disk by content: a killed run takes up where it was. One file a unit, written
//! under a temporary name and renamed; a damaged one is measured again.

use crate::error::CliError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use umbrage_metrics::{SumKind, SumTable};

/// A variant in a window, measured in one way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Unit {
    pub(crate) tables: BTreeMap<SumKind, SumTable>,
    /// The middle frame as a game would show it, in 8 bits, for the crop; empty where there is none.
    #[serde(skip)]
    pub(crate) mask: Vec<u8>,
}

/// A folder of units that may be shared by processes.
pub(crate) struct Store {
    folder: PathBuf,
}

/// Hexadecimal digits of a blake3 hash.
const HASH: usize = 64;

impl Store {
    pub(crate) fn open(folder: &Path) -> Result<Self, CliError> {
        std::fs::create_dir_all(folder).map_err(CliError::file(folder))?;
        Ok(Self { folder: folder.into() })
    }

    /// A unit that is there and whole: hash, length of the numbers, numbers, mask.
    pub(crate) fn read(&self, key: &str) -> Option<Unit> {
        let bytes = std::fs::read(self.folder.join(key)).ok()?;
        let (hash, body) = bytes.split_at_checked(HASH)?;
        if blake3::hash(body).to_hex().as_bytes() != hash {
            return None;
        }
        let (length, rest) = body.split_at_checked(8)?;
        let length = u64::from_le_bytes(length.try_into().ok()?);
        let (numbers, mask) = rest.split_at_checked(usize::try_from(length).ok()?)?;
        let unit: Unit = serde_json::from_slice(numbers).ok()?;
        Some(Unit { mask: mask.to_vec(), ..unit })
    }

    /// A disk that does not take it loses nothing but time: the run goes on.
    pub(crate) fn write(&self, key: &str, unit: &Unit) {
        let temporary = self.folder.join(format!("tmp-{}-{}", std::process::id(), &key[..16]));
        let written = serde_json::to_vec(unit).ok().and_then(|numbers| {
            let mut body = (numbers.len() as u64).to_le_bytes().to_vec();
            body.extend(numbers);
            body.extend(&unit.mask);
            let hash = blake3::hash(&body).to_hex();
            std::fs::write(&temporary, [hash.as_bytes(), &body].concat()).ok()?;
            std::fs::rename(&temporary, self.folder.join(key)).ok()
        });
        if written.is_none() {
            let _ = std::fs::remove_file(&temporary);
        }
    }
}
