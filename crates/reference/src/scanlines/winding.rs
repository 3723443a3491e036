//! Layers before each sample, counted edge by edge.
//!
//! On each row an edge changes the number of layers before all samples on its right. Vertices belong to edges by
//! half-open ranges across the rows, so that the outline of a triangle counts each sample 0 or 1 times.

use super::edges::Seen;
use super::eight::{Eight, LANES};
use super::frame::{Frame, Turn};
use super::lines::{Lines, REPLICATES, RISE, Ruling};
use super::outline::MARGIN;

/// Samples of a row that fit into a word, a byte each.
const PER_WORD: usize = 8;

/// What a byte may hold before it is moved on, either sign.
const MOST: u8 = 127;

/// Of each row, in words of all replicates: word, replicate, sample.
type Bytes = [u8; REPLICATES * PER_WORD];

/// Layers before each sample of a receiver.
#[derive(Default)]
pub(super) struct Winding {
    bytes: Vec<Bytes>,
    /// What the bytes of a row may hold by now.
    full: Vec<u8>,
    /// What did not fit into bytes; empty while all fits.
    more: Vec<[i32; REPLICATES * PER_WORD]>,
    words: usize,
    /// Layers before every sample.
    all: i32,
}

impl Winding {
    #[inline(always)]
    pub(super) fn start(&mut self, ruling: &Ruling) {
        let [_, rows, per_row] = ruling.size();
        self.words = (per_row as usize).div_ceil(PER_WORD);
        self.bytes.clear();
        self.bytes.resize(rows as usize * self.words, [0; REPLICATES * PER_WORD]);
        self.full.clear();
        self.full.resize(rows as usize, 0);
        self.more.clear();
        self.all = 0;
    }

    /// Adds what a receiver sees of eight edges.
    #[inline(always)]
    pub(super) fn add(
        &mut self,
        seen: &Seen,
        lines: &Lines,
        (frame, ruling, turn): (&Frame, &Ruling, &Turn),
    ) {
        let [p, q, r] = seen.line;
        let across = p * Eight::all(turn.xx) + q * Eight::all(turn.yx);
        let along = p * Eight::all(turn.xy) + q * Eight::all(turn.yy);
        // An edge along the rows becomes one that all but is.
        let least = Eight::all(1e-12) * (along.abs() + r.abs()) + Eight::all(f32::MIN_POSITIVE);
        let across = across.abs().max(least).signed_as(across);
        let per = -(Eight::all(1.0) / across);
        let (slope, at) = (along * per, r * per);
        // Ends in the rows' coordinates: the turn's inverse, whose determinant is 1.
        let from = turned(turn, &seen.from);
        let to = turned(turn, &seen.to);
        let (low, high) = (from[1].min(to[1]), from[1].max(to[1]));
        let (left, right) = (from[0].min(to[0]), from[0].max(to[0]));
        let rising = from[1].below(to[1]).bits();
        // Off the light on the right nothing changes.
        let away = Eight::all(1.0 + MARGIN).below(left).bits();
        // Off it on the left every sample of a row has the layer; rows all lie within this.
        let end = Eight::all(1.0 + 2.0 * RISE as f32 / ruling.rows as f32 + MARGIN);
        let beyond = right.below(Eight::all(-1.0 - MARGIN));
        let beyond = beyond.and(low.below(-end)).and(end.below(high)).bits();
        let [first, last] = frame.rows(ruling, low, high);
        let mut some = nonzero(seen.weight) & !away;
        while some != 0 {
            let lane = some.trailing_zeros() as usize;
            some &= some - 1;
            let weight = seen.weight[lane];
            let weight = if rising >> lane & 1 != 0 { weight } else { -weight };
            if beyond >> lane & 1 != 0 {
                self.all += i32::from(weight);
                continue;
            }
            let last = (last[lane] as usize).min(lines.rows.len());
            let first = (first[lane] as usize).min(last);
            let line = [slope.0[lane], at.0[lane]];
            self.edge(lines, frame, first..last, (line, [low.0[lane], high.0[lane]], weight));
        }
    }

    /// One edge: `x = slope y + at` between two places across the rows.
    #[inline(always)]
    fn edge(
        &mut self,
        lines: &Lines,
        frame: &Frame,
        rows: std::ops::Range<usize>,
        ([slope, at], [low, high], weight): ([f32; 2], [f32; 2], i8),
    ) {
        let half = Eight::all(0.5 * lines.per_row);
        let word = u64::from(weight as u8) * 0x0101_0101_0101_0101;
        let words = self.words;
        for j in rows {
            let row = &lines.rows[j];
            let mut x = Eight::all(slope) * row.y + Eight::all(at);
            if let Some(cone) = &frame.cone {
                x = cone.along(x, row.cos);
            }
            let before = (x * half + (half - row.shift)).number();
            let full = self.full[j] + weight.unsigned_abs();
            self.full[j] = full;
            if full > MOST {
                self.spill(j);
                self.full[j] = weight.unsigned_abs();
            }
            let mut pattern = [0u64; LANES];
            for k in 0..LANES {
                let crossed = row.y.0[k] >= low && row.y.0[k] < high;
                pattern[k] = if crossed { word } else { 0 };
            }
            for w in 0..words {
                let mut shifted = [0u64; LANES];
                for k in 0..LANES {
                    let number = before[k].saturating_sub((w * PER_WORD) as u32);
                    shifted[k] = pattern[k].unbounded_shl(8 * number);
                }
                let shifted: Bytes = bytemuck::cast(shifted);
                let bytes = &mut self.bytes[j * words + w];
                for i in 0..REPLICATES * PER_WORD {
                    bytes[i] = bytes[i].wrapping_add(shifted[i]);
                }
            }
        }
    }

    /// Makes room in the bytes of a row.
    #[cold]
    fn spill(&mut self, row: usize) {
        self.more.resize(self.bytes.len(), [0; REPLICATES * PER_WORD]);
        for at in row * self.words..(row + 1) * self.words {
            for (more, byte) in self.more[at].iter_mut().zip(&mut self.bytes[at]) {
                *more += i32::from(*byte as i8);
                *byte = 0;
            }
        }
    }

    /// Hides the samples that have a layer before them.
    #[inline(always)]
    pub(super) fn hide(&self, lines: &mut Lines) {
        let words = self.words;
        for (j, row) in lines.rows.iter_mut().enumerate() {
            for w in 0..words {
                let at = j * words + w;
                let bytes = &self.bytes[at];
                let mut hidden = [0u8; REPLICATES * PER_WORD];
                if let Some(more) = self.more.get(at) {
                    for i in 0..REPLICATES * PER_WORD {
                        let layers = more[i] + i32::from(bytes[i] as i8) + self.all;
                        hidden[i] = if layers != 0 { 0xff } else { 0 };
                    }
                } else {
                    // What a byte holds is above -128 and below 128.
                    let none = match i8::try_from(-self.all) {
                        Ok(none) => none as u8,
                        Err(_) => 0x80,
                    };
                    for i in 0..REPLICATES * PER_WORD {
                        hidden[i] = if bytes[i] != none { 0xff } else { 0 };
                    }
                }
                for k in 0..REPLICATES {
                    let mut word = [0; PER_WORD];
                    word.copy_from_slice(&hidden[k * PER_WORD..(k + 1) * PER_WORD]);
                    let word = u64::from_le_bytes(word);
                    // A bit of each byte, gathered in the highest.
                    let bits = (word & 0x8040_2010_0804_0201).wrapping_mul(0x0101_0101_0101_0101) >> 56;
                    row.hidden[k] |= (bits as u32) << (w * PER_WORD);
                }
            }
        }
    }
}

/// A bit for each that is not 0.
#[inline(always)]
fn nonzero(bytes: [i8; LANES]) -> u32 {
    const LOW: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    let word = u64::from_le_bytes(bytes.map(|byte| byte as u8));
    // The highest bit of each byte, gathered in the highest byte.
    let bits = ((word & LOW).wrapping_add(LOW) | word) & !LOW;
    ((bits >> 7).wrapping_mul(0x0102_0408_1020_4080) >> 56) as u32
}

/// In the rows' coordinates.
#[inline(always)]
fn turned(turn: &Turn, [x, y]: &[Eight; 2]) -> [Eight; 2] {
    [
        Eight::all(turn.yy) * *x - Eight::all(turn.xy) * *y,
        Eight::all(-turn.yx) * *x + Eight::all(turn.xx) * *y,
    ]
}
