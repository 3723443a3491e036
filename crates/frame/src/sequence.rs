//! Numbered files: `shadow.####.exr`, `shadow.%04d.exr`, `shadow.*.exr`, a folder, or one file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The files of a sequence by their numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NumberedFiles {
    /// As it was asked for.
    pub pattern: String,
    /// Number and file, ascending.
    pub files: BTreeMap<u32, PathBuf>,
}

/// Why a pattern names no sequence.
#[derive(Debug, thiserror::Error)]
pub enum SequenceError {
    /// A folder that cannot be listed.
    #[error("{}: {source}", path.display())]
    Folder {
        /// Which folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// No file fits.
    #[error("no file fits {pattern}{}", near(.found))]
    Nothing {
        /// As it was asked for.
        pattern: String,
        /// Some that are there instead.
        found: Vec<String>,
    },
    /// Two files of one number.
    #[error("{pattern}: {} and {} are both frame {number}", first.display(), second.display())]
    Twice {
        /// As it was asked for.
        pattern: String,
        /// The number.
        number: u32,
        /// A file of it.
        first: PathBuf,
        /// Another.
        second: PathBuf,
    },
}

fn near(found: &[String]) -> String {
    if found.is_empty() { String::new() } else { format!("; there is {}", found.join(", ")) }
}

/// Formats that frames are read from.
const FORMATS: [&str; 2] = ["exr", "png"];
/// Files that a message lists.
const LISTED: usize = 4;

impl NumberedFiles {
    /// Finds them.
    ///
    /// # Errors
    /// A folder that cannot be listed, no file, or two of one number.
    pub fn find(pattern: &str) -> Result<Self, SequenceError> {
        let given = Path::new(pattern);
        let (folder, name) = match given.is_dir() {
            true => (given, None),
            false => (given.parent().unwrap_or(Path::new("")), given.file_name()),
        };
        let name = name.map(|n| n.to_string_lossy().into_owned());
        let listed = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let at = |source| SequenceError::Folder { path: listed.into(), source };
        let mut all: Vec<PathBuf> =
            std::fs::read_dir(listed).map_err(at)?.flatten().map(|e| folder.join(e.file_name())).collect();
        all.sort();
        let mut files = BTreeMap::new();
        for path in &all {
            let Some(number) = number_of(path, name.as_deref()) else { continue };
            if let Some(first) = files.insert(number, path.clone()) {
                let (pattern, second) = (pattern.into(), path.clone());
                return Err(SequenceError::Twice { pattern, number, first, second });
            }
        }
        if files.is_empty() {
            let pictures = all.iter().filter(|p| is_picture(p)).take(LISTED);
            let found = pictures.map(|p| p.display().to_string()).collect();
            return Err(SequenceError::Nothing { pattern: pattern.into(), found });
        }
        Ok(Self { pattern: pattern.into(), files })
    }

    /// Numbers between the first and the last that have no file.
    pub fn holes(&self) -> Vec<u32> {
        let (Some(first), Some(last)) = (self.files.keys().next(), self.files.keys().last()) else {
            return Vec::new();
        };
        (*first..=*last).filter(|n| !self.files.contains_key(n)).collect()
    }
}

fn is_picture(path: &Path) -> bool {
    path.extension().is_some_and(|e| FORMATS.iter().any(|f| e.eq_ignore_ascii_case(f)))
}

/// The number of a file that fits; a file that is named outright and has none is 0.
fn number_of(path: &Path, pattern: Option<&str>) -> Option<u32> {
    let name = path.file_name()?.to_str()?;
    let Some(pattern) = pattern else { return if is_picture(path) { trailing(name) } else { None } };
    if pattern == name {
        return Some(trailing(name).unwrap_or(0));
    }
    if let Some((before, after)) = pattern.split_once('*') {
        let middle = name.strip_prefix(before)?.strip_suffix(after)?;
        return trailing(middle).or_else(|| trailing(name));
    }
    let (before, after, width) = placeholder(pattern)?;
    let digits = name.strip_prefix(before)?.strip_suffix(after)?;
    let fits = digits.len() >= width && digits.chars().all(|c| c.is_ascii_digit());
    // Longer than the placeholder only where the number needs it: 10000 in ####.
    let padded = digits.len() == width || !digits.starts_with('0');
    if fits && padded { digits.parse().ok() } else { None }
}

/// What stands before and after `####` or `%04d`, and how many digits it means.
fn placeholder(pattern: &str) -> Option<(&str, &str, usize)> {
    if let Some(start) = pattern.find('#') {
        let width = pattern[start..].chars().take_while(|&c| c == '#').count();
        return Some((&pattern[..start], &pattern[start + width..], width));
    }
    let start = pattern.find('%')?;
    let end = start + pattern[start..].find('d')?;
    let width = &pattern[start + 1..end];
    let width = if width.is_empty() { 1 } else { width.parse().ok()? };
    Some((&pattern[..start], &pattern[end + 1..], width))
}

/// The digits before the extension: of "shadow.0012.exr" 12, of "shadow_7.exr" 7.
fn trailing(name: &str) -> Option<u32> {
    let is_format = |end: &str| FORMATS.iter().any(|f| end.eq_ignore_ascii_case(f));
    let stem = name.rsplit_once('.').filter(|(_, end)| is_format(end)).map_or(name, |(stem, _)| stem);
    let kept = stem.trim_end_matches(|c: char| c.is_ascii_digit());
    stem[kept.len()..].parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_pattern_finds_its_files() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let names =
            ["s.0001.exr", "s.0002.exr", "s.0004.exr", "s.10000.exr", "t_7.png", "notes.txt", "s.x.exr"];
        for name in names {
            std::fs::write(folder.path().join(name), "").expect("written");
        }
        let find = |pattern: &str| NumberedFiles::find(&folder.path().join(pattern).to_string_lossy());
        let numbers = |pattern: &str| find(pattern).expect(pattern).files.into_keys().collect::<Vec<_>>();
        assert_eq!(numbers("s.####.exr"), [1, 2, 4, 10000]);
        assert_eq!(numbers("s.%04d.exr"), [1, 2, 4, 10000]);
        assert_eq!(numbers("s.*.exr"), [1, 2, 4, 10000]);
        assert_eq!(numbers("t_#.png"), [7]);
        assert_eq!(numbers("t_7.png"), [7]);
        assert_eq!(numbers("s.x.exr"), [0]);
        assert_eq!(numbers(""), [1, 2, 4, 7, 10000]);
        std::fs::remove_file(folder.path().join("s.10000.exr")).expect("removed");
        assert_eq!(find("s.####.exr").expect("found").holes(), [3]);
        let nothing = find("u.####.exr").expect_err("nothing").to_string();
        assert!(nothing.contains("u.####.exr") && nothing.contains("s.0001.exr"), "{nothing}");
        std::fs::write(folder.path().join("t_07.png"), "").expect("written");
        let twice = find("t_*.png").expect_err("twice").to_string();
        assert!(twice.contains("t_07.png") && twice.contains("both frame 7"), "{twice}");
        assert!(NumberedFiles::find("/nowhere/at/all.####.exr").is_err());
    }
}
