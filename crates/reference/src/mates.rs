//! Which sides of triangles lie on each other.

use glam::Vec3;
use rayon::prelude::*;

/// No other side lies there.
const ALONE: u32 = u32::MAX;

/// For each side of each triangle, one side of another triangle between the same two places. Side k goes from corner
/// k to the next. Where more than two meet at an edge they are taken in pairs, those of opposite directions first.
/// 8 times the other's slot, 2 times its side, and 1 if it goes the other way.
pub(crate) struct Mates(Vec<[u32; 3]>);

/// A side of another triangle.
#[derive(Clone, Copy)]
pub(crate) struct Mate {
    pub(crate) slot: u32,
    pub(crate) side: usize,
    /// Whether it goes the other way, as between neighbours with the same winding.
    pub(crate) opposite: bool,
}

/// A side in the list of those that start at the same place: where it ends, and 3 slot + k.
#[derive(Clone, Copy)]
struct Entry {
    to: u32,
    side: u32,
}

impl Mates {
    /// Of triangles by their vertices; vertices at one place are one.
    pub(crate) fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let mut mates = vec![[ALONE; 3]; triangles.len()];
        // More do not fit; without mates all is slower and the same.
        if 8 * triangles.len() >= ALONE as usize {
            return Self(mates);
        }
        let place = places(positions);
        let side = |slot: usize, k: usize| {
            let triangle = &triangles[slot];
            [place[triangle[k] as usize], place[triangle[(k + 1) % 3] as usize]]
        };
        // Lists by the lower end, laid out one after the other.
        let mut start = vec![0u32; positions.len() + 1];
        let each = || (0..triangles.len()).flat_map(|slot| (0..3).map(move |k| (slot, k)));
        for (slot, k) in each() {
            let [from, to] = side(slot, k);
            start[from.min(to) as usize + 1] += 1;
        }
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        let mut next = start.clone();
        let mut entries = vec![Entry { to: 0, side: 0 }; 3 * triangles.len()];
        for (slot, k) in each() {
            let [from, to] = side(slot, k);
            let into = &mut next[from.min(to) as usize];
            entries[*into as usize] = Entry { to: from.max(to), side: (3 * slot + k) as u32 };
            *into += 1;
        }
        let rises = |index: u32| {
            let [from, to] = side(index as usize / 3, index as usize % 3);
            from < to
        };
        let mut pair = |a: u32, b: u32, opposite: bool| {
            for (one, other) in [(a, b), (b, a)] {
                let mate = (other / 3) << 3 | (other % 3) << 1 | u32::from(opposite);
                mates[one as usize / 3][one as usize % 3] = mate;
            }
        };
        for range in start.windows(2) {
            let list = &mut entries[range[0] as usize..range[1] as usize];
            list.sort_unstable_by_key(|e| (e.to, e.side));
            for edge in list.chunk_by(|a, b| a.to == b.to) {
                let mut waiting: [Vec<u32>; 2] = Default::default();
                for entry in edge {
                    let rises = rises(entry.side);
                    match waiting[usize::from(!rises)].pop() {
                        Some(other) => pair(other, entry.side, true),
                        None => waiting[usize::from(rises)].push(entry.side),
                    }
                }
                for same in waiting {
                    same.as_chunks::<2>().0.iter().for_each(|&[a, b]| pair(a, b, false));
                }
            }
        }
        Self(mates)
    }

    /// What lies on side k of a triangle.
    #[inline(always)]
    pub(crate) fn of(&self, slot: u32, k: usize) -> Option<Mate> {
        let mate = self.0[slot as usize][k];
        let [slot, side] = [mate >> 3, mate >> 1 & 3];
        (mate != ALONE).then_some(Mate { slot, side: side as usize, opposite: mate & 1 != 0 })
    }
}

/// A number for each vertex, the same for those at one place.
fn places(positions: &[Vec3]) -> Vec<u32> {
    // Adding 0 turns -0 into 0.
    let key = |i: u32| positions[i as usize].to_array().map(|c| (c + 0.0).to_bits());
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.par_sort_unstable_by_key(|&i| key(i));
    let mut place = vec![0; positions.len()];
    for same in order.chunk_by(|&a, &b| key(a) == key(b)) {
        for &i in same {
            place[i as usize] = same[0];
        }
    }
    place
}
