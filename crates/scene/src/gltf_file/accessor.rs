//! Numbers out of a glTF file's buffers.
//!
//! The gltf crate's own readers panic on parts that do not fit together; these say what is wrong.

use gltf::accessor::{DataType, Dimensions, sparse::IndexType};
use gltf::buffer::{Source, View};
use gltf::{Accessor, Document};
use std::path::Path;

/// Numbers that an accessor without a buffer may hold: a guard against a count without data.
const MOST_ZEROS: usize = 1 << 28;

/// The bytes of every buffer.
pub(super) struct Buffers(Vec<Vec<u8>>);

impl Buffers {
    /// Reads data URIs, the binary part of a .glb, and files relative to `folder`.
    pub(super) fn read(
        document: &Document,
        mut blob: Option<Vec<u8>>,
        folder: &Path,
    ) -> Result<Self, String> {
        let mut buffers = Vec::new();
        for buffer in document.buffers() {
            let bytes = match buffer.source() {
                Source::Bin => blob.take().ok_or("the binary part is missing")?,
                Source::Uri(uri) => read_uri(uri, folder)?,
            };
            if bytes.len() < buffer.length() {
                let (index, wanted) = (buffer.index(), buffer.length());
                return Err(format!("buffer {index} is truncated: {} of {wanted} bytes", bytes.len()));
            }
            buffers.push(bytes);
        }
        Ok(Self(buffers))
    }

    /// All numbers of an accessor, element after element; integers are taken as parts of their
    /// largest value.
    pub(super) fn numbers(&self, accessor: &Accessor, expected: Dimensions) -> Result<Vec<f64>, String> {
        if accessor.dimensions() != expected {
            let found = accessor.dimensions();
            return Err(format!("accessor {} holds {found:?}, not {expected:?}", accessor.index()));
        }
        self.components(accessor, number_from)
    }

    /// The bytes of a view; `None` when its buffer is too short.
    pub(super) fn view(&self, view: &View) -> Option<&[u8]> {
        self.0.get(view.buffer().index())?.get(view.offset()..)?.get(..view.length())
    }

    /// All indices of an accessor.
    pub(super) fn indices(&self, accessor: &Accessor) -> Result<Vec<u32>, String> {
        let whole = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
        if !whole || accessor.dimensions() != Dimensions::Scalar {
            return Err(format!("accessor {} holds no indices", accessor.index()));
        }
        self.components(accessor, |_, bytes| whole_from(bytes))
    }

    fn components<T: Clone + Default>(
        &self,
        accessor: &Accessor,
        read: fn(DataType, &[u8]) -> T,
    ) -> Result<Vec<T>, String> {
        let kind = accessor.data_type();
        let per_element = accessor.dimensions().multiplicity();
        let decode = |element: &[u8]| -> Vec<T> {
            element.chunks_exact(kind.size()).map(|component| read(kind, component)).collect()
        };
        let too_short = || format!("accessor {} reaches beyond its buffer", accessor.index());
        let size = accessor.size();
        let mut values = match accessor.view() {
            Some(view) => {
                let elements = self.elements(&view, accessor.offset(), accessor.count(), size);
                elements.ok_or_else(too_short)?.into_iter().flat_map(decode).collect()
            }
            None => {
                let total = accessor.count().checked_mul(per_element).filter(|&n| n <= MOST_ZEROS);
                vec![T::default(); total.ok_or_else(too_short)?]
            }
        };
        let Some(sparse) = accessor.sparse() else { return Ok(values) };
        let (indices, replaced) = (sparse.indices(), sparse.values());
        let index_size = match indices.index_type() {
            IndexType::U8 => 1,
            IndexType::U16 => 2,
            IndexType::U32 => 4,
        };
        let at = self.elements(&indices.view(), indices.offset(), sparse.count(), index_size);
        let new = self.elements(&replaced.view(), replaced.offset(), sparse.count(), size);
        for (index, element) in at.ok_or_else(too_short)?.into_iter().zip(new.ok_or_else(too_short)?) {
            let first = whole_from(index) as usize * per_element;
            let place = values.get_mut(first..first + per_element).ok_or_else(too_short)?;
            place.clone_from_slice(&decode(element));
        }
        Ok(values)
    }

    /// The bytes of each element; `None` when the view or the buffer is too short.
    fn elements(&self, view: &View, offset: usize, count: usize, size: usize) -> Option<Vec<&[u8]>> {
        let bytes = self.view(view)?;
        let stride = view.stride().unwrap_or(size);
        let bytes = bytes.get(offset..)?;
        // Before anything of this length is made.
        if count > bytes.len() / size.max(1) + 1 && stride >= size {
            return None;
        }
        (0..count)
            .map(|i| {
                let start = i.checked_mul(stride)?;
                bytes.get(start..start.checked_add(size)?)
            })
            .collect()
    }
}

/// The bytes of a data URI or of a file beside the model.
pub(super) fn read_uri(uri: &str, folder: &Path) -> Result<Vec<u8>, String> {
    if uri.starts_with("data:") {
        let data = gltf::buffer::Data::from_source(Source::Uri(uri), None);
        return data.map(|data| data.0).map_err(|error| format!("data URI: {error}"));
    }
    let name = percent_decoded(uri).ok_or_else(|| format!("'{uri}' is no file name"))?;
    std::fs::read(folder.join(&name)).map_err(|error| format!("cannot read {name}: {error}"))
}

/// File names are percent-encoded in glTF.
fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let hex = after.get(..2).and_then(|two| std::str::from_utf8(two).ok());
        match hex.and_then(|two| u8::from_str_radix(two, 16).ok()).filter(|_| first == b'%') {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).ok()
}

/// A little-endian whole number of up to four bytes.
fn whole_from(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte))
}

/// glTF 2.0, section 3.6.2.2 (data types) and 3.11 (normalised integers of animations).
fn number_from(kind: DataType, bytes: &[u8]) -> f64 {
    let whole = whole_from(bytes);
    match kind {
        DataType::I8 => (f64::from(whole as u8 as i8) / 127.0).max(-1.0),
        DataType::U8 => f64::from(whole) / 255.0,
        DataType::I16 => (f64::from(whole as u16 as i16) / 32767.0).max(-1.0),
        DataType::U16 => f64::from(whole) / 65535.0,
        DataType::U32 => f64::from(whole),
        DataType::F32 => f64::from(f32::from_bits(whole)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decodes_names_and_numbers() {
        assert_eq!(percent_decoded("a%20b%C3%A9.bin").as_deref(), Some("a bé.bin"));
        assert_eq!(percent_decoded("100%").as_deref(), Some("100%"));
        assert_eq!(percent_decoded("%FF"), None);
        assert_eq!(number_from(DataType::I8, &[0x81]), -1.0);
        assert_eq!(number_from(DataType::I8, &[0x80]), -1.0);
        assert_eq!(number_from(DataType::U16, &[0xFF, 0xFF]), 1.0);
        assert_eq!(number_from(DataType::F32, &1.5f32.to_le_bytes()), 1.5);
    }
}
