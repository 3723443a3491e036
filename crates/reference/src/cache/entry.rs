//! The bytes of one cache entry: a header of 64 bytes, then the lists.
//!
//! | bytes | what |
//! | --- | --- |
//! | 0..8 | `UMBTRUTH` |
//! | 8..12 | version |
//! | 12..16 | 0 |
//! | 16..24 | points |
//! | 24..32 | points with a basis: all or none |
//! | 32..64 | BLAKE3 of everything else |
//!
//! Then, little-endian f32 lists in the order mean, half, half, variance, basis, a list of u32 for the
//! samples of the mean, and a byte per point for facing.

use crate::GroundTruth;

/// Changes whenever the layout or the meaning of the numbers does.
pub(super) const VERSION: u32 = 3;
const MAGIC: &[u8; 8] = b"UMBTRUTH";
const HEADER: usize = 64;
const SUM: std::ops::Range<usize> = 32..64;

pub(super) fn encode(truth: &GroundTruth) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + truth.mean.len() * 25);
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    bytes.extend([0; 4]);
    bytes.extend((truth.mean.len() as u64).to_le_bytes());
    bytes.extend((truth.basis.len() as u64).to_le_bytes());
    bytes.extend([0; 32]);
    for list in [&truth.mean, &truth.halves[0], &truth.halves[1], &truth.variance, &truth.basis] {
        bytes.extend(list.iter().flat_map(|v| v.to_le_bytes()));
    }
    bytes.extend(truth.samples.iter().flat_map(|s| s.to_le_bytes()));
    bytes.extend(truth.facing.iter().map(|&f| u8::from(f)));
    let sum = checksum(&bytes);
    bytes[SUM].copy_from_slice(&sum);
    bytes
}

/// `None` for anything but a whole entry of this version.
pub(super) fn decode(bytes: &[u8]) -> Option<GroundTruth> {
    let header = bytes.get(..HEADER)?;
    if &header[..8] != MAGIC || header[8..12] != VERSION.to_le_bytes() || header[SUM] != checksum(bytes) {
        return None;
    }
    let length = |at: usize| -> Option<usize> {
        usize::try_from(u64::from_le_bytes(header[at..at + 8].try_into().ok()?)).ok()
    };
    let (points, basis) = (length(16)?, length(24)?);
    let mut rest = &bytes[HEADER..];
    let mut words = |length: usize| -> Option<&[[u8; 4]]> {
        let (head, tail) = rest.split_at_checked(length.checked_mul(4)?)?;
        rest = tail;
        Some(head.as_chunks::<4>().0)
    };
    let mut list = |length| -> Option<Vec<f32>> {
        Some(words(length)?.iter().map(|&b| f32::from_le_bytes(b)).collect())
    };
    let mean = list(points)?;
    let halves = [list(points)?, list(points)?];
    let (variance, basis) = (list(points)?, list(basis)?);
    let samples = words(points)?.iter().map(|&b| u32::from_le_bytes(b)).collect();
    let facing = rest.iter().map(|&b| b != 0).collect();
    (rest.len() == points).then_some(GroundTruth { mean, halves, basis, variance, samples, facing })
}

/// Of an entry without its checksum.
fn checksum(bytes: &[u8]) -> [u8; 32] {
    let mut hasher = blake3::Hasher::new();
    hasher.update(&bytes[..SUM.start]);
    hasher.update(&bytes[SUM.end..]);
    *hasher.finalize().as_bytes()
}
