//! Blue-noise points in a disc: the alternative to Vogel's disc that the first document tried (T9).
//! Its demo ships tables; ours are made by Mitchell's best candidate ("Spectrally Optimal Sampling
//! for Distribution Ray Tracing", SIGGRAPH 1991, section 4): each point is the one of many random
//! candidates that lies farthest from the points before it.

use crate::Fragment;
use std::sync::LazyLock;

/// Candidates per point already chosen.
const CANDIDATES: u32 = 64;

/// `count` points of the unit disc, the same on every machine.
pub(crate) fn disc(count: usize) -> Vec<[f32; 2]> {
    let mut state = 0x2545_f491u32;
    let mut chosen: Vec<[f32; 2]> = Vec::with_capacity(count);
    while chosen.len() < count {
        let candidates = CANDIDATES * (1 + chosen.len() as u32);
        let all: Vec<[f32; 2]> = (0..candidates).map(|_| in_disc(&mut state)).collect();
        let best = all.into_iter().max_by(|a, b| clearance(&chosen, *a).total_cmp(&clearance(&chosen, *b)));
        chosen.extend(best);
    }
    chosen
}

/// Squared distance to the nearest point, or to the disc's border, which is as good as a point half
/// as far: otherwise points would crowd there.
fn clearance(chosen: &[[f32; 2]], p: [f32; 2]) -> f32 {
    let border = 2.0 * (1.0 - (p[0] * p[0] + p[1] * p[1]).sqrt());
    let squared = |q: &[f32; 2]| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2);
    chosen.iter().map(squared).fold(border * border, f32::min)
}

fn in_disc(state: &mut u32) -> [f32; 2] {
    loop {
        let p = [unit(state), unit(state)].map(|u| 2.0 * u - 1.0);
        if p[0] * p[0] + p[1] * p[1] <= 1.0 {
            return p;
        }
    }
}

/// 24 bits of a linear congruential generator with PCG's output permutation.
fn unit(state: &mut u32) -> f32 {
    *state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((*state >> ((*state >> 28) + 4)) ^ *state).wrapping_mul(277_803_737);
    (((word >> 22) ^ word) >> 8) as f32 / 16_777_216.0
}

/// Slot `kernel_tap` with 16 points.
static KERNEL_16: LazyLock<Fragment> = LazyLock::new(|| kernel("kernel_blue_16", 16));
/// The same with 32.
static KERNEL_32: LazyLock<Fragment> = LazyLock::new(|| kernel("kernel_blue_32", 32));

/// Slot `kernel_tap` for the first 16 or for 32 points.
pub(crate) fn kernel_fragment(taps: u32) -> Fragment {
    if taps <= 16 { KERNEL_16.clone() } else { KERNEL_32.clone() }
}

fn kernel(name: &'static str, count: usize) -> Fragment {
    let points = disc(count).into_iter().map(|[x, y]| format!("    vec2({x:.7}, {y:.7}),\n"));
    let source = format!(
        "// Slot `kernel_tap`: {count} blue-noise points, made by `blue_noise.rs`. Unit radius.\n\
         fn kernel_tap(i: u32, count: u32, turn: vec2<f32>) -> vec2<f32> {{\n    \
         return turned(BLUE[i], turn);\n}}\n\nvar<private> BLUE: array<vec2<f32>, {count}> = array<vec2<f32>, {count}>(\n{});\n",
        points.collect::<String>()
    );
    Fragment { name: name.into(), source: source.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No two points are nearer than .6 of the densest packing's spacing (hexagonal: area of the
    /// disc = count x spacing^2 x sqrt(3) / 2); random points come as near as a tenth of it.
    #[test]
    fn points_keep_their_distance_and_fill_the_disc() {
        for count in [16usize, 32] {
            let points = disc(count);
            let packing = (std::f32::consts::PI * 2.0 / (3f32.sqrt() * count as f32)).sqrt();
            for (k, &p) in points.iter().enumerate() {
                assert!(p[0].hypot(p[1]) <= 1.0);
                for q in &points[..k] {
                    let apart = (p[0] - q[0]).hypot(p[1] - q[1]);
                    assert!(apart > 0.6 * packing, "{count}: {apart} of {packing}");
                }
            }
            // Uniform over the disc: the mean squared radius is 1/2, its standard error of
            // independent points .29 / sqrt(count); blue noise is well within twice that.
            let mean = points.iter().map(|p| p[0] * p[0] + p[1] * p[1]).sum::<f32>() / count as f32;
            assert!((mean - 0.5).abs() < 2.0 * 0.29 / (count as f32).sqrt(), "{count}: {mean}");
        }
    }
}
