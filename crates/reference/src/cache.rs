//! Ground truth on disk, by content.
//!
//! `<folder>/ab/cdef...` holds the truth of the key `abcdef...`. An entry is written under a
//! temporary name in `<folder>/tmp`, flushed to disk and renamed, so that an entry that exists is
//! whole; its checksum is verified on each read all the same, because disks and people edit files.
//! Two processes that miss the same key both compute it, write the same bytes, and the later rename
//! wins. Nothing here waits for another process.

mod entry;

use crate::{GroundTruth, Points, ReferenceError, Tracer, TruthSettings};
use std::fmt;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use umbrage_device::AdapterDescription;
use umbrage_scene::AreaLight;

/// A folder of ground truth that may be shared by processes.
#[derive(Clone, Debug)]
pub struct Cache {
    folder: PathBuf,
}

/// The content that a truth follows from: scene, points, light, settings and tool version.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TruthKey([u8; 32]);

impl TruthKey {
    /// Of the same truth found on a GPU: adapter and driver are a part of its content.
    pub(crate) fn on(self, adapter: &AdapterDescription) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&self.0);
        for part in [&adapter.name, &adapter.driver, &adapter.backend] {
            hasher.update(&(part.len() as u64).to_le_bytes());
            hasher.update(part.as_bytes());
        }
        Self(*hasher.finalize().as_bytes())
    }
}

impl fmt::Display for TruthKey {
    /// 64 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&blake3::Hash::from_bytes(self.0).to_hex())
    }
}

/// Where a truth came from.
#[derive(Debug)]
pub enum Source {
    /// Read from disk, and its checksum is right.
    Stored,
    /// Computed and stored.
    Computed,
    /// There was an entry, but not a whole one: computed and stored again.
    Repaired,
    /// Computed, but the disk would not take it: a later run computes it again.
    NotStored(io::Error),
}

impl Tracer {
    /// The key of a truth that this tracer finds.
    pub fn truth_key(&self, points: &Points, light: &AreaLight, settings: &TruthSettings) -> TruthKey {
        let mut hasher = blake3::Hasher::new();
        hasher.update(concat!("umbrage truth ", env!("CARGO_PKG_VERSION")).as_bytes());
        hasher.update(&entry::VERSION.to_le_bytes());
        hasher.update(&self.scene_hash);
        hasher.update(&light.content_hash());
        let TruthSettings { samples, replicates, basis_samples, seed, method, tolerance } = *settings;
        for number in [samples, replicates, basis_samples, method as u32] {
            hasher.update(&number.to_le_bytes());
        }
        hasher.update(&seed.to_le_bytes());
        hasher.update(&tolerance.unwrap_or(0.0).to_le_bytes());
        hasher.update(&(points.len() as u64).to_le_bytes());
        hasher.update(bytemuck::cast_slice(&points.position));
        hasher.update(bytemuck::cast_slice(&points.normal));
        hasher.update(bytemuck::cast_slice(&points.triangle));
        TruthKey(*hasher.finalize().as_bytes())
    }
}

impl Cache {
    /// Opens a folder, creating it if needed, and clears away what killed runs left behind.
    ///
    /// # Errors
    /// When the folder cannot be created or listed.
    pub fn open(folder: impl Into<PathBuf>) -> Result<Self, ReferenceError> {
        let cache = Self { folder: folder.into() };
        let temporary = cache.temporary();
        let sweep = fs::create_dir_all(&temporary).and_then(|()| sweep(&temporary));
        sweep.map_err(|source| cache.error(source))?;
        Ok(cache)
    }

    /// The truth of a key: from disk if a whole entry is there, otherwise computed and stored. A
    /// damaged entry is computed again, and a full or read-only disk loses nothing; [`Source`]
    /// tells.
    ///
    /// # Errors
    /// When an entry exists that cannot be read (permissions, a failing disk).
    pub fn truth(
        &self,
        key: TruthKey,
        compute: impl FnOnce() -> GroundTruth,
    ) -> Result<(GroundTruth, Source), ReferenceError> {
        self.try_truth(key, || Ok(compute()))
    }

    /// As [`Cache::truth`], of what may fail to be computed.
    ///
    /// # Errors
    /// When an entry exists that cannot be read, and those of `compute`.
    pub fn try_truth(
        &self,
        key: TruthKey,
        compute: impl FnOnce() -> Result<GroundTruth, ReferenceError>,
    ) -> Result<(GroundTruth, Source), ReferenceError> {
        let path = self.path(key);
        let source = match fs::read(&path) {
            Ok(bytes) => match entry::decode(&bytes) {
                Some(truth) => return Ok((truth, Source::Stored)),
                None => Source::Repaired,
            },
            Err(error) if error.kind() == ErrorKind::NotFound => Source::Computed,
            Err(source) => return Err(ReferenceError::Cache { path, source }),
        };
        let truth = compute()?;
        match self.store(&path, &entry::encode(&truth)) {
            Ok(()) => Ok((truth, source)),
            Err(error) => Ok((truth, Source::NotStored(error))),
        }
    }

    /// Where the entry of a key is kept.
    pub fn path(&self, key: TruthKey) -> PathBuf {
        let hex = key.to_string();
        let (shelf, name) = hex.split_at(2);
        self.folder.join(shelf).join(name)
    }

    fn temporary(&self) -> PathBuf {
        self.folder.join("tmp")
    }

    fn store(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let (temporary, file) = self.create_temporary()?;
        let stored = write(file, bytes).and_then(|()| publish(&temporary, path));
        if stored.is_err() {
            // Best effort: the next `open` sweeps what stays.
            let _ = fs::remove_file(&temporary);
        }
        stored
    }

    /// A file that nobody else writes to, locked for as long as its writer lives.
    fn create_temporary(&self) -> io::Result<(PathBuf, File)> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        loop {
            let number = NEXT.fetch_add(1, Ordering::Relaxed);
            let path = self.temporary().join(format!("{}-{number}", std::process::id()));
            match File::create_new(&path) {
                Ok(file) => {
                    // Where locks do not exist, nobody sweeps either.
                    let _ = file.lock();
                    return Ok((path, file));
                }
                // A killed process had this number once.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
    }

    fn error(&self, source: io::Error) -> ReferenceError {
        ReferenceError::Cache { path: self.folder.clone(), source }
    }
}

fn write(mut file: File, bytes: &[u8]) -> io::Result<()> {
    file.write_all(bytes)?;
    file.sync_all()
}

/// Makes a whole file visible under its name, in one step.
fn publish(temporary: &Path, path: &Path) -> io::Result<()> {
    let shelf = path.parent().ok_or(ErrorKind::InvalidInput)?;
    fs::create_dir_all(shelf)?;
    fs::rename(temporary, path)?;
    // The rename outlives a power cut only once the folder is flushed. Not every system can do that
    // to a folder, and the entry is whole without it.
    let _ = File::open(shelf).and_then(|folder| folder.sync_all());
    Ok(())
}

/// Removes temporary files whose writers are gone: those that can be locked.
fn sweep(temporary: &Path) -> io::Result<()> {
    for item in fs::read_dir(temporary)? {
        let path = item?.path();
        let abandoned = File::open(&path).is_ok_and(|file| file.try_lock().is_ok());
        if abandoned {
            // Another process may sweep at the same time.
            let _ = fs::remove_file(&path);
        }
    }
    Ok(())
}
