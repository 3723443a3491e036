//! Twin of the patterns: interleaved gradient noise (listing 2), its seedings, Vogel's disc
//! (listing 1), and PCG as a hash (Jarzynski and Olano 2020).

use super::approx::{Approx, UNKNOWN, sum};
use umbrage_shadows::Seeding;

/// Which pattern: its seeding, frame and seed, and a number that sets passes apart (0 for the last
/// pass, 1 for the penumbra mask).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pattern {
    pub(crate) seeding: Seeding,
    pub(crate) frame: u32,
    pub(crate) seed: u32,
    pub(crate) pass: u32,
}

impl Pattern {
    /// Turns (0 to 1) at a pixel; the error is meant round the circle.
    pub(crate) fn turns(&self, pixel: [u32; 2]) -> Approx {
        let shift = self.shift();
        let noise = gradient_noise(pixel.map(|c| Approx::exact(f64::from(c) + 0.5) + shift));
        (noise + Approx::exact(self.phase(pixel))).fract()
    }

    /// Of the noise with y times 4 (listing 7).
    pub(crate) fn tall_turns(&self, pixel: [u32; 2]) -> Approx {
        let [x, y] = pixel.map(|c| Approx::exact(f64::from(c) + 0.5) + self.shift());
        let noise = gradient_noise([x, Approx::exact(4.0) * y]);
        (noise + Approx::exact(self.phase(pixel))).fract()
    }

    /// Of white noise: 24 bits of a hash of the pixel.
    pub(crate) fn white_turns(&self, pixel: [u32; 2]) -> f64 {
        let [x, y] = pixel.map(|c| (f64::from(c) + 0.5 + self.shift().value) as u32);
        let hash = pcg(x ^ pcg(y ^ 0x9e37_79b9));
        (f64::from(hash >> 8) / 16_777_216.0 + self.phase(pixel)).fract()
    }

    fn shift(&self) -> Approx {
        match self.seeding {
            // The step that engines ship (Jimenez 2014), over 64 frames.
            Seeding::Animated => Approx::constant(5.588238) * Approx::exact((self.frame % 64).into()),
            Seeding::Fresh | Seeding::Frozen => Approx::exact(0.0),
        }
    }

    /// What is added to the noise, from 24 bits of a hash of hashes. Fresh: an offset for the frame,
    /// the seed, the pass and the block of 16 x 16 pixels. Otherwise: one for the seed and the pass,
    /// none for seed 0.
    pub(crate) fn phase(&self, pixel: [u32; 2]) -> f64 {
        let [x, y] = pixel.map(|c| c / 16);
        let chain = match self.seeding {
            Seeding::Fresh => vec![self.pass, self.frame, self.seed, y, x],
            Seeding::Frozen | Seeding::Animated if self.seed == 0 => return 0.0,
            Seeding::Frozen | Seeding::Animated => vec![self.pass, self.seed],
        };
        let hash = chain.into_iter().fold(0, |hash, word| pcg(word ^ hash));
        f64::from(hash / 256) / 16_777_216.0
    }
}

/// 0 to 1 for a place in pixels.
fn gradient_noise([x, y]: [Approx; 2]) -> Approx {
    let inner = sum(&[Approx::constant(0.06711056) * x, Approx::constant(0.00583715) * y]);
    let outer = Approx::constant(52.9829189) * inner.fract();
    // Where the inner fraction may wrap, the noise may be anything.
    let wraps = inner.floors().count() > 1;
    if wraps { Approx { error: UNKNOWN, ..outer } } else { outer.fract() }
}

/// PCG-RXS-M-XS of 32 bits: a step of the generator, then its output permutation.
fn pcg(seed: u32) -> u32 {
    let state = seed.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let shifted = state.wrapping_shr((state >> 28) + 4);
    let word = (shifted ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// Tap `i` of `count` on Vogel's disc of radius 1, turned by `phi` (radians).
pub(crate) fn vogel(i: u32, count: u32, phi: Approx) -> [Approx; 2] {
    let radius = Approx::exact(f64::from(i) + 0.5).sqrt() / Approx::exact(count.into()).sqrt();
    let theta = Approx::exact(i.into()) * Approx::constant(2.4) + phi;
    [radius * theta.cos(), radius * theta.sin()]
}
