//! The triangles before a group of receivers, joined to patches.

use super::blocks::Blocks;
use super::clip::Cut;
use super::eight::LANES;
use super::facing::Standpoint;
use super::whereabouts::Whereabouts;
use crate::surfaces::Surfaces;
use glam::Vec3;

/// What is known of one candidate.
#[derive(Clone, Copy)]
struct Candidate {
    slot: u32,
    /// 8 times its block, and its lane.
    at: u32,
    /// Another of the same patch with a lower number, or itself.
    parent: u32,
    owner: u32,
    /// 1 or -1; 0 where it depends on the receiver.
    side: i8,
    clear: bool,
    cut: Cut,
}

const NOT_CUT: Cut = Cut { near: false, far: false };

/// All of them.
#[derive(Default)]
pub(super) struct Candidates {
    list: Vec<Candidate>,
    whereabouts: Whereabouts,
    /// Of each candidate: a bit for each side that one before it has met.
    met: Vec<u8>,
    kept: Vec<Kept>,
}

/// A side of a candidate at which the number of layers may change.
struct Kept {
    candidate: u32,
    side: usize,
    /// The candidate beyond, and whether its side goes the other way.
    beyond: Option<(u32, bool)>,
}

/// An edge where the number of layers may change.
pub(super) struct Edge {
    pub(super) ends: [Vec3; 2],
    /// Up to two owners, and what each adds; the second 0 at a border.
    pub(super) owners: [u32; 2],
    pub(super) sides: [i8; 2],
    /// Whether an owner's side depends on the receiver.
    pub(super) open: bool,
}

/// A triangle whose side depends on the receiver.
pub(super) struct Open {
    pub(super) slot: u32,
    pub(super) corners: [Vec3; 3],
    pub(super) clear: bool,
}

impl Candidate {
    /// What it adds, times what it is to a receiver if it is open.
    fn adds(&self) -> i8 {
        if self.side == 0 { 1 } else { self.side }
    }

    #[inline(always)]
    fn corner(&self, all: &Blocks, k: usize) -> Vec3 {
        all.blocks[self.at as usize / LANES].corner(self.at as usize % LANES, k)
    }

    fn corners(&self, all: &Blocks) -> [Vec3; 3] {
        all.blocks[self.at as usize / LANES].triangle(self.at as usize % LANES)
    }
}

impl Candidates {
    /// Takes what is surely between all receivers and the light; the others stay behind in `rest`.
    #[inline(always)]
    pub(super) fn take(&mut self, standpoint: Option<&Standpoint>, all: &Blocks, rest: &mut Blocks) {
        self.list.clear();
        rest.clear();
        for (b, block) in all.blocks.iter().enumerate() {
            let Some(standpoint) = standpoint else {
                for lane in 0..block.used().count_ones() as usize {
                    rest.push(block.slots[lane], &block.triangle(lane));
                }
                continue;
            };
            let sure = standpoint.sure(block);
            let mut some = block.used() & !sure.never;
            if some & !sure.clear != 0 {
                some &= sure.clear | !standpoint.skips(block);
            }
            let sided = sure.clear & sure.sided;
            let taken = some & (sure.nearer | sure.cut_far) & (sure.front | sure.cut_near);
            let mut left = some & !taken;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                rest.push(block.slots[lane], &block.triangle(lane));
            }
            let mut left = taken;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                let is = |bits: u32| bits >> lane & 1 != 0;
                let side = i8::from(is(sided)) - 2 * i8::from(is(sided & sure.behind));
                let parent = self.list.len() as u32;
                self.list.push(Candidate {
                    slot: block.slots[lane],
                    at: (LANES * b + lane) as u32,
                    parent,
                    owner: 0,
                    side,
                    clear: is(sure.clear),
                    cut: Cut { near: !is(sure.front), far: !is(sure.below) },
                });
            }
        }
    }

    /// Gives each patch a number, then each triangle that is open; calls back with the latter. Returns how many patches
    /// there are.
    #[inline(always)]
    pub(super) fn name_owners(&mut self, all: &Blocks, mut open: impl FnMut(&Open)) -> usize {
        let mut patches = 0;
        for i in 0..self.list.len() {
            let Candidate { parent, side, .. } = self.list[i];
            if side == 0 {
                continue;
            }
            if parent == i as u32 {
                self.list[i].owner = patches;
                patches += 1;
            } else {
                self.list[i].owner = self.list[parent as usize].owner;
            }
        }
        for (owner, candidate) in (patches..).zip(self.list.iter_mut().filter(|c| c.side == 0)) {
            candidate.owner = owner;
            let Candidate { slot, clear, .. } = *candidate;
            open(&Open { slot, corners: candidate.corners(all), clear });
        }
        patches as usize
    }

    /// Names every edge at which the number of layers may change, with triangles cut at a plane.
    #[inline(always)]
    pub(super) fn edges(&self, all: &Blocks, standpoint: Option<&Standpoint>, mut put: impl FnMut(Edge)) {
        let Some(standpoint) = standpoint else { return };
        let clip = standpoint.clip();
        for Kept { candidate, side: k, beyond } in &self.kept {
            let one = &self.list[*candidate as usize];
            let ends = [one.corner(all, *k), one.corner(all, (k + 1) % 3)];
            let ends = match clip {
                Some(clip) if one.cut != NOT_CUT => clip.between(ends, one.cut),
                _ => Some(ends),
            };
            let Some(ends) = ends else { continue };
            let mut edge = Edge { ends, owners: [one.owner; 2], sides: [one.adds(), 0], open: one.side == 0 };
            if let Some((beyond, reverse)) = *beyond {
                let other = &self.list[beyond as usize];
                edge.owners[1] = other.owner;
                edge.sides[1] = if reverse { -other.adds() } else { other.adds() };
                edge.open |= other.side == 0;
            }
            put(edge);
        }
        let Some(clip) = clip else { return };
        for one in self.list.iter().filter(|c| c.cut != NOT_CUT) {
            for ends in clip.across(&one.corners(all), one.cut).into_iter().flatten() {
                put(Edge { ends, owners: [one.owner; 2], sides: [one.adds(), 0], open: one.side == 0 });
            }
        }
    }

    /// Makes patches of neighbours whose common edge changes nothing, and keeps all other edges.
    pub(super) fn join(&mut self, surfaces: &Surfaces) {
        self.whereabouts.clear(surfaces.corners.len());
        for (i, candidate) in self.list.iter().enumerate() {
            self.whereabouts.set(candidate.slot, i as u32);
        }
        self.kept.clear();
        self.met.clear();
        self.met.resize(self.list.len(), 0);
        for i in 0..self.list.len() {
            let Candidate { slot, side, .. } = self.list[i];
            for k in 0..3 {
                if self.met[i] >> k & 1 != 0 {
                    continue;
                }
                let mate = surfaces.mates.of(slot, k);
                let mate = mate.and_then(|mate| Some((self.whereabouts.find(mate.slot)?, mate)));
                let Some((beyond, mate)) = mate else {
                    self.kept.push(Kept { candidate: i as u32, side: k, beyond: None });
                    continue;
                };
                let reverse = mate.opposite;
                self.met[beyond as usize] |= 1 << mate.side;
                // Two sides of one triangle.
                if beyond as usize == i {
                    continue;
                }
                let other = self.list[beyond as usize].side;
                let cancel = if reverse { side == other } else { side == -other };
                if side != 0 && cancel {
                    let (a, b) = (self.root(i as u32), self.root(beyond));
                    self.list[a.max(b) as usize].parent = a.min(b);
                } else {
                    self.kept.push(Kept { candidate: i as u32, side: k, beyond: Some((beyond, reverse)) });
                }
            }
        }
    }

    /// Of a patch, with the ways to it halved (Tarjan and van Leeuwen 1984).
    #[inline(always)]
    fn root(&mut self, mut i: u32) -> u32 {
        loop {
            let parent = self.list[i as usize].parent;
            if parent == i {
                return i;
            }
            let up = self.list[parent as usize].parent;
            self.list[i as usize].parent = up;
            i = up;
        }
    }
}
