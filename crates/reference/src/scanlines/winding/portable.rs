//! Rows without special instructions.

use super::{Bytes, EACH, ORDER, PER_WORD, Registers, Run};
use crate::scanlines::eight::{Eight, Mask};
use crate::scanlines::frame::Cone;
use crate::scanlines::lines::{REPLICATES, Row};

#[derive(Clone, Copy)]
pub(super) struct Portable;

impl Registers for Portable {
    #[inline(always)]
    fn before(self, run: &Run, row: &Row, layers: &mut [i32; REPLICATES]) {
        let added = crosses(run, row).pick_words(run.weight as u32, [0; REPLICATES]);
        for k in 0..REPLICATES {
            layers[k] += added[k] as i32;
        }
    }

    #[inline(always)]
    fn across<const WORDS: usize>(
        self,
        run: &Run,
        row: &Row,
        (cone, half): (Option<&Cone>, f32),
        words: &mut [Bytes; WORDS],
    ) {
        let mut x = Eight::all(run.slope) * row.y + Eight::all(run.at);
        if let Some(cone) = cone {
            x = cone.along(x, row.cos);
        }
        let half = Eight::all(half);
        let before = (x * half + (half - row.shift)).number();
        let crossed = crosses(run, row).pick_words(u32::MAX, [0; REPLICATES]);
        let weight = u64::from(run.weight as u8) * EACH;
        for (w, words) in words.iter_mut().enumerate() {
            let mut shifted = [0u64; REPLICATES];
            for (into, k) in shifted.iter_mut().zip(ORDER) {
                let number = before[k].saturating_sub((w * PER_WORD) as u32);
                let pattern = if crossed[k] != 0 { weight } else { 0 };
                *into = pattern.unbounded_shl(8 * number).to_le();
            }
            let shifted: [u8; REPLICATES * PER_WORD] = bytemuck::cast(shifted);
            for (byte, shifted) in words.0.iter_mut().zip(shifted) {
                *byte = byte.wrapping_add(shifted);
            }
        }
    }

    #[inline(always)]
    fn none(self, bytes: &Bytes, layers: &[i32; REPLICATES]) -> [u8; REPLICATES] {
        let mut none = [0; REPLICATES];
        for (i, &byte) in bytes.0.iter().enumerate() {
            let empty = i32::from(byte as i8) + layers[ORDER[i / PER_WORD]] == 0;
            none[i / PER_WORD] |= u8::from(empty) << (i % PER_WORD);
        }
        none
    }
}

/// Which replicates of a row an edge crosses.
#[inline(always)]
fn crosses(run: &Run, row: &Row) -> Mask {
    row.y.below(Eight::all(run.low)).not().and(row.y.below(Eight::all(run.high)))
}
