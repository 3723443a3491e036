//! Twin of every read of the shadow map. A comparison that f32 may decide either way is left open:
//! results are then sets or ranges, and say how many decisions were open.

use super::approx::Approx;
use super::light::{Light, Point};
use super::pattern::vogel;
use umbrage_frame::Image;
use umbrage_shadows::Bias;

/// The map, as the pipeline rendered it.
pub(crate) struct Map<'a> {
    pub(crate) light: &'a Light,
    pub(crate) depths: &'a Image<f32>,
    pub(crate) bias: Bias,
}

/// The lit fraction: all that f32 may make of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lit {
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Comparisons and texel choices that rounding decides.
    pub(crate) open: u32,
}

/// What a comparison says.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Compared {
    Lit,
    Dark,
    Open,
}

/// Blocker depths that a search may find on average; `None` among them stands for no blocker.
pub(crate) type Blockers = Vec<Option<Approx>>;

/// Depths that are not told apart, metres: a mean over 32 taps knows them to 1/32 of it.
const SAME_BLOCKER: f64 = 0.02;
/// More alternatives than this are not followed.
const MOST_ALTERNATIVES: usize = 64;

impl Lit {
    const FULLY: Self = Self { low: 1.0, high: 1.0, open: 0 };
    const ANYTHING: Self = Self { low: 0.0, high: 1.0, open: 1 };

    fn or(self, other: Self) -> Self {
        let differs = self.low != other.low || self.high != other.high;
        let open = self.open.max(other.open).max(u32::from(differs));
        Self { low: self.low.min(other.low), high: self.high.max(other.high), open }
    }

    fn mean(taps: &[Self]) -> Self {
        let count = taps.len() as f64;
        let low = taps.iter().map(|t| t.low).sum::<f64>() / count;
        let high = taps.iter().map(|t| t.high).sum::<f64>() / count;
        // A sum of n terms and a quotient of at most 1.
        let rounding = (count + 5.0) * super::approx::U;
        // Whole taps add up exactly.
        let whole = taps.iter().all(|t| t.low == t.high && (t.low == 0.0 || t.low == 1.0));
        let rounding = if whole && (count as u32).is_power_of_two() { 0.0 } else { rounding };
        Self { low: low - rounding, high: high + rounding, open: taps.iter().map(|t| t.open).sum() }
    }

    pub(crate) fn admits(&self, result: f32) -> bool {
        self.low <= f64::from(result) && f64::from(result) <= self.high
    }
}

impl Map<'_> {
    fn side(&self) -> i64 {
        i64::from(self.light.texels)
    }

    /// Depth of a texel (of the border's where it lies outside) against the receiver's there.
    fn compare(&self, point: &Point, [x, y]: [i64; 2]) -> (f64, Compared) {
        let last = self.side() - 1;
        let depth = f64::from(*self.depths.at(x.clamp(0, last) as u32, y.clamp(0, last) as u32));
        let centre = [x, y].map(|c| Approx::exact(c as f64 + 0.5) / Approx::exact(self.side() as f64));
        let reference = self.light.reference(point, centre, &self.bias);
        let compared = if reference.high() <= depth {
            Compared::Lit
        } else if reference.low() > depth {
            Compared::Dark
        } else {
            Compared::Open
        };
        (depth, compared)
    }

    /// The tap's place in texels.
    fn place(&self, point: &Point, offset: [Approx; 2]) -> [Approx; 2] {
        let side = Approx::exact(self.side() as f64);
        [0, 1].map(|k| (point.uv[k] + offset[k]) * side)
    }

    fn is_outside(&self, [x, y]: [i64; 2]) -> bool {
        !(0..self.side()).contains(&x) || !(0..self.side()).contains(&y)
    }

    /// One comparison with the texel in which the tap lies; outside the map everything is lit.
    pub(crate) fn nearest(&self, point: &Point, offset: [Approx; 2]) -> Lit {
        let Some(texels) = texels_at(self.place(point, offset)) else { return Lit::ANYTHING };
        let each = texels.into_iter().map(|texel| {
            let compared = if self.is_outside(texel) { Compared::Lit } else { self.compare(point, texel).1 };
            match compared {
                Compared::Lit => Lit::FULLY,
                Compared::Dark => Lit { low: 0.0, high: 0.0, open: 0 },
                Compared::Open => Lit::ANYTHING,
            }
        });
        each.reduce(Lit::or).unwrap_or(Lit::ANYTHING)
    }

    /// The comparisons of the four texels round a tap, weighted by its distances to their centres.
    pub(crate) fn bilinear(&self, point: &Point, offset: [Approx; 2]) -> Lit {
        let place = self.place(point, offset);
        let Some(inside) = texels_at(place) else { return Lit::ANYTHING };
        if inside.iter().all(|&texel| self.is_outside(texel)) {
            return Lit::FULLY;
        }
        let corner = place.map(|c| c.value - 0.5);
        let base = corner.map(|c| c.floor() as i64);
        let [wx, wy] = [0, 1].map(|k| corner[k] - base[k] as f64);
        let mut tap = Lit { low: 0.0, high: 0.0, open: 0 };
        for (dx, dy, weight) in [
            (0, 0, (1.0 - wx) * (1.0 - wy)),
            (1, 0, wx * (1.0 - wy)),
            (0, 1, (1.0 - wx) * wy),
            (1, 1, wx * wy),
        ] {
            let compared = self.compare(point, [base[0] + dx, base[1] + dy]).1;
            tap.low += if compared == Compared::Lit { weight } else { 0.0 };
            tap.high += if compared == Compared::Dark { 0.0 } else { weight };
            tap.open += u32::from(compared == Compared::Open);
        }
        // A tap displaced by its error changes by at most that much per axis, also across texel
        // centres (a texel's comparison does not depend on the tap); six roundings of at most 1.
        let slack = place[0].error + place[1].error + 6.0 * super::approx::U;
        let crosses = place.iter().any(|&c| (c - Approx::exact(0.5)).floors().count() > 1);
        let uniform = tap.open == 0 && (tap.low <= 0.0 || tap.low >= 1.0 - 1e-12);
        if !uniform || crosses {
            tap.low = (tap.low - slack).max(0.0);
            tap.high = (tap.high + slack).min(1.0);
        } else {
            // All four agree: exactly dark, or lit to the rounding of complementary weights.
            tap.low = tap.low.round() * (1.0 - 4.0 * super::approx::U);
            tap.high = tap.high.round();
        }
        if inside.iter().any(|&texel| self.is_outside(texel)) { tap.or(Lit::FULLY) } else { tap }
    }

    /// The mean over bilinear taps on a disc.
    pub(crate) fn disc(&self, point: &Point, (radius, angle): (Approx, Approx), taps: u32) -> Lit {
        let tap = |i| self.bilinear(point, vogel(i, taps, angle).map(|c| radius * c));
        Lit::mean(&(0..taps).map(tap).collect::<Vec<_>>())
    }

    /// The mean over a square grid of texels.
    pub(crate) fn grid(&self, point: &Point, step: Approx, side: i32) -> Lit {
        let middle = side / 2;
        let offset = |k: i32| Approx::exact((k - middle).into()) * step;
        let tap = |k: i32| self.nearest(point, [offset(k % side), offset(k / side)]);
        Lit::mean(&(0..side * side).map(tap).collect::<Vec<_>>())
    }

    /// Listing 3: the mean depth of the taps that lie before the receiver. `None` where too much
    /// is open.
    pub(crate) fn blockers(
        &self,
        point: &Point,
        (radius, angle): (Approx, Approx),
        taps: u32,
    ) -> Option<Blockers> {
        let mut sums = vec![(Approx::exact(0.0), 0u32)];
        for i in 0..taps {
            let found = self.blocker_at(point, vogel(i, taps, angle).map(|c| radius * c))?;
            let add = |(sum, count): (Approx, u32), depth: Option<Approx>| match depth {
                Some(depth) => (sum + depth, count + 1),
                None => (sum, count),
            };
            sums = sums.iter().flat_map(|&s| found.iter().map(move |&depth| add(s, depth))).collect();
            if sums.len() > MOST_ALTERNATIVES {
                return None;
            }
        }
        let mean = |(sum, count): (Approx, u32)| (count > 0).then(|| sum / Approx::exact(count.into()));
        Some(sums.into_iter().map(mean).collect())
    }

    /// What a search tap may find: nothing, or a depth.
    fn blocker_at(&self, point: &Point, offset: [Approx; 2]) -> Option<Vec<Option<Approx>>> {
        let (mut none, mut depths) = (false, Vec::new());
        for texel in texels_at(self.place(point, offset))? {
            let (depth, compared) = self.compare(point, texel);
            let compared = if self.is_outside(texel) { Compared::Lit } else { compared };
            none |= compared != Compared::Dark;
            depths.extend((compared != Compared::Lit).then_some(depth));
        }
        depths.sort_by(f64::total_cmp);
        let range = |group: &[f64]| {
            let (low, high) = (group[0], group[group.len() - 1]);
            Some(Approx { value: 0.5 * (low + high), error: 0.5 * (high - low) })
        };
        // Neighbouring texels of one surface are one outcome.
        let mut found: Vec<_> = depths.chunk_by(|a, b| b - a < SAME_BLOCKER).map(range).collect();
        if none {
            found.push(None);
        }
        Some(found)
    }
}

/// The texels in which a place may lie; `None` when that says nothing.
fn texels_at(place: [Approx; 2]) -> Option<Vec<[i64; 2]>> {
    if place.iter().any(|c| c.error > 0.5) {
        return None;
    }
    let [columns, rows] = place.map(Approx::floors);
    Some(rows.flat_map(|y| columns.clone().map(move |x| [x, y])).collect())
}
