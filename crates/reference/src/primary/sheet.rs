//! A triangle as the pixels of a tile see it: functions that are linear in a pixel's place.
//!
//! With corners a, b, c relative to the eye, sides ab and ac, n = ab x ac and D = n.a, a direction d towards a
//! pixel meets the triangle's plane at t = D / d.n, at the barycentric weights d.(ac x a) and d.(a x ab) over d.n
//! of b and c. Before the division all are linear in d, which is linear in the pixel's place, for triangles beside
//! and behind the eye too (Olano and Greer 1997). Turned so that D > 0, the triangle is hit where the three weights
//! are not negative, and 1/t is the sum of the three over D.
//!
//! `surfaces::intersect` decides in f64 with roundings of its own. What it may take for a hit, or for nearer, these
//! functions do not miss, since each is raised by its slack:
//! - Both start with the same rounded a, ab and ac. A product of three vectors then takes no more than 10
//!   roundings of 2^-53 relative to the product of their sizes (sums of absolute coordinates), on both sides; d's
//!   own, and those of sums and quotients of weights, make it less than 32: [`EXACT`] is twice that. The sizes are
//!   d's, a side's, and a's or the other side's.
//! - In f32 a value takes seven roundings before the row's steps, and one for each: less than 16 of 2^-24 relative to
//!   the largest value in the tile: [`SINGLE`].

use super::tile::HALF;
use glam::DVec3;

const EXACT: f64 = 64.0 / (1u64 << 53) as f64;
const SINGLE: f64 = 16.0 / (1 << 24) as f64;

/// Where a tile looks.
pub(super) struct Sight {
    pub(super) eye: DVec3,
    /// Direction of its middle, and of one pixel to the right and one down.
    pub(super) middle: DVec3,
    pub(super) right: DVec3,
    pub(super) down: DVec3,
    /// Of all directions, at most.
    pub(super) length: f64,
}

/// Three weights and the nearness 1/t. Each is raised by its slack: what is negative is not hit.
#[derive(Clone, Copy)]
pub(super) struct Sheet {
    /// At the middle of the first row.
    pub(super) at: [f32; 4],
    pub(super) across: [f32; 4],
    pub(super) down: [f32; 4],
    /// A pixel whose weights are all above this is hit.
    pub(super) sure: f32,
}

/// What a tile knows of a triangle.
pub(super) enum Aspect {
    /// No pixel hits it, or only where it is less near than `least`.
    Nowhere,
    /// The functions decide.
    Here(Sheet),
    /// The eye is in its plane, or the numbers leave f32: any pixel may hit it.
    Unknown,
}

impl Aspect {
    #[inline(always)]
    pub(super) fn new(sight: &Sight, [a, b, c]: [DVec3; 3], least: f64) -> Self {
        let (ab, ac, a) = (b - a, c - a, a - sight.eye);
        let n = ab.cross(ac);
        let volume = n.dot(a);
        let turned = 1f64.copysign(volume);
        let (n, v, w) = (n * turned, ac.cross(a) * turned, a.cross(ab) * turned);
        let side = size(ab) + size(ac);
        let away = size(a);
        let volume = volume.abs();
        // 1/t may be off by this times d's size for d.n, and by this times a's size, in parts, for D.
        let lost = EXACT * side * side / volume;
        let slack = EXACT * sight.length * side * (away + side);
        // Infinite, or not a number, where D is zero.
        if !(lost * away < SINGLE && slack > 1e-30 && slack < 1e30 && volume > 1e-30 && volume < 1e30) {
            return Self::Unknown;
        }
        let mut values = [[0.0; 3]; 4];
        for (i, place) in [sight.middle, sight.right, sight.down].into_iter().enumerate() {
            let (sum, of_b, of_c) = (place.dot(n), place.dot(v), place.dot(w));
            values[0][i] = sum - of_b - of_c;
            values[1][i] = of_b;
            values[2][i] = of_c;
            values[3][i] = sum / volume;
        }
        let mut sheet = Sheet { at: [0.0; 4], across: [0.0; 4], down: [0.0; 4], sure: 0.0 };
        let mut out = false;
        for (i, [at, across, down]) in values.into_iter().enumerate() {
            let reach = HALF[0] * across.abs() + HALF[1] * down.abs();
            let largest = at.abs() + reach;
            // D's part is less than SINGLE, see above.
            let (slack, lowest) = match i {
                3 => (lost * sight.length + 2.0 * SINGLE * largest, least),
                _ => (slack + SINGLE * largest, 0.0),
            };
            out |= at + reach + slack < lowest;
            sheet.at[i] = (at + slack - HALF[1] * down) as f32;
            sheet.across[i] = across as f32;
            sheet.down[i] = down as f32;
            if i < 3 {
                sheet.sure = sheet.sure.max(2.0 * slack as f32);
            }
        }
        if out { Self::Nowhere } else { Self::Here(sheet) }
    }
}

/// The sum of the absolute coordinates: no less than a vector's length.
#[inline(always)]
fn size(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}
