//! Between text and [`SceneFile`], with the place of a mistake.

use super::{KeyframeList, SceneFile};
use crate::SceneError;
use serde::de::DeserializeOwned;
use std::path::Path;

const HEADER: &str = "\
# A scene for Umbrage. Metres, y up, right-handed; azimuths run from +x (0) towards +z (90 degrees).
# Paths of files are relative to this file. Edit anything: unknown fields are refused by name.

";

pub(super) fn to_toml(file: &SceneFile) -> String {
    // Every field of SceneFile is a plain table, array, number or string, which TOML can hold.
    let body = toml::to_string(file).unwrap_or_default();
    format!("{HEADER}{body}")
}

pub(super) fn from_toml<T: DeserializeOwned>(source: &str, path: &Path) -> Result<T, SceneError> {
    toml::from_str(source).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        let at = unknown_field(error.message()).and_then(|field| find_field(source, start, field));
        let (line, column) = line_and_column(source, at.unwrap_or(start));
        SceneError::Syntax { path: path.to_owned(), line, column, message: error.message().to_owned() }
    })
}

/// Keyframes from the text of a `.toml` file, or of JSON.
pub(crate) fn keyframes_from(source: &str, path: &Path) -> Result<KeyframeList, SceneError> {
    if path.extension().is_some_and(|extension| extension == "toml") {
        return from_toml(source, path);
    }
    serde_json::from_str(source).map_err(|error| SceneError::Syntax {
        path: path.to_owned(),
        line: error.line(),
        column: error.column(),
        message: error.to_string(),
    })
}

/// The name in serde's "unknown field `name`".
fn unknown_field(message: &str) -> Option<&str> {
    message.strip_prefix("unknown field `")?.split('`').next()
}

/// Where a field stands within the table that starts at `from`. Serde buffers a table that says its
/// `kind`, which loses the place of the fields in it; the table's own place remains.
fn find_field(source: &str, from: usize, field: &str) -> Option<usize> {
    let mut offset = from;
    for (i, line) in source.get(from..)?.split_inclusive('\n').enumerate() {
        if i > 0 && line.starts_with('[') {
            return None;
        }
        let at = line.match_indices(field).find(|&(at, _)| is_key(line, at, field));
        if let Some((at, _)) = at {
            return Some(offset + at);
        }
        offset += line.len();
    }
    None
}

fn is_key(line: &str, at: usize, field: &str) -> bool {
    let before = line[..at].trim_end();
    let after = line[at + field.len()..].trim_start();
    after.starts_with('=') && (before.is_empty() || before.ends_with(['{', ',']))
}

/// Both from 1; the column counts characters.
fn line_and_column(source: &str, offset: usize) -> (usize, usize) {
    let before = source.get(..offset).unwrap_or(source);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}
