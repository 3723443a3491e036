//! Owen-scrambled Sobol points in the unit square, many scrambles of one table.
//!
//! The scrambling hash and the direction numbers are `sobol_burley`'s (Burley 2020, "Practical
//! Hash-based Owen Scrambling"). Its index shuffle is left out: it serves padding to more than
//! two dimensions, which nothing here needs.

use sobol_burley::parts::{owen_scramble_rev, sobol_rev};

/// The longest sequence that `sobol_burley` has.
pub(crate) const LONGEST: u32 = 1 << 16;

/// The first points of the Sobol sequence with their bits reversed, as the scramble wants them.
pub(crate) struct Sobol {
    x: Vec<u32>,
    y: Vec<u32>,
}

impl Sobol {
    /// The first `count` points, at most [`LONGEST`].
    pub(crate) fn new(count: u32) -> Self {
        let axis = |d: u32| (0..count.min(LONGEST)).map(|i| sobol_rev(i.reverse_bits(), d)).collect();
        Self { x: axis(0), y: axis(1) }
    }

    /// The first points, scrambled, in [0, 1)^2: as many as the slices take.
    pub(crate) fn scramble(&self, seed: u64, x: &mut [f32], y: &mut [f32]) {
        let bits = mix(seed);
        scramble_axis(&self.x, bits as u32, x);
        scramble_axis(&self.y, (bits >> 32) as u32, y);
    }
}

fn scramble_axis(table: &[u32], scramble: u32, out: &mut [f32]) {
    for (out, &point) in out.iter_mut().zip(table) {
        *out = unit(owen_scramble_rev(point, scramble).reverse_bits());
    }
}

/// The upper 24 bits as a number in [0, 1).
pub(crate) fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / (1 << 24) as f32)
}

/// A bijection of 64-bit words that looks random (the finaliser of SplitMix64, Steele et al. 2014).
pub(crate) fn mix(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Folds words into a seed, in order.
pub(crate) fn fold(seed: u64, words: impl IntoIterator<Item = u32>) -> u64 {
    words.into_iter().fold(mix(seed), |state, word| mix(state ^ u64::from(word)))
}
