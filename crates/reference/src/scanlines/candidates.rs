//! The triangles before a group of receivers, joined to patches.

use super::blocks::Blocks;
use super::clip::Clip;
use super::facing::Standpoint;
use crate::surfaces::Surfaces;
use glam::Vec3;

/// A triangle without edges here.
const NOWHERE: u32 = u32::MAX;

/// What is known of one candidate.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    pub(super) slot: u32,
    pub(super) corners: [Vec3; 3],
    /// 1 or -1; 0 where it depends on the receiver.
    pub(super) side: i8,
    pub(super) clear: bool,
    /// Whether it has to be cut before all receivers.
    cut: bool,
    /// Another of the same patch, or itself.
    parent: u32,
    pub(super) owner: u32,
}

/// All of them.
#[derive(Default)]
pub(super) struct Candidates {
    list: Vec<Candidate>,
    /// Slots and their candidates, open addressing.
    table: Vec<(u32, u32)>,
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

impl Candidate {
    /// What it adds, times what it is to a receiver if it is open.
    fn adds(&self) -> i8 {
        if self.side == 0 { 1 } else { self.side }
    }
}

impl Candidates {
    /// Takes what is surely between all receivers and the light; the others stay behind in `rest`.
    #[inline(always)]
    pub(super) fn take(&mut self, standpoint: Option<&Standpoint>, all: &Blocks, rest: &mut Blocks) {
        self.list.clear();
        rest.clear();
        for block in &all.blocks {
            let sure = standpoint.map(|standpoint| (standpoint, standpoint.sure(block)));
            for lane in 0..block.used().count_ones() as usize {
                let (slot, corners) = (block.slots[lane], block.triangle(lane));
                let Some((standpoint, sure)) = sure else {
                    rest.push(slot, &corners);
                    continue;
                };
                let is = |bits: u32| bits >> lane & 1 != 0;
                if is(sure.never) || !is(sure.clear) && standpoint.skips(&corners) {
                    continue;
                }
                let sided = is(sure.clear & sure.sided);
                let cut = !is(sure.front);
                if !is(sure.nearer) || cut && !(sided && standpoint.clip().is_some()) {
                    rest.push(slot, &corners);
                    continue;
                }
                let side = match (sided, is(sure.behind)) {
                    (false, _) => 0,
                    (true, false) => 1,
                    (true, true) => -1,
                };
                let parent = self.list.len() as u32;
                let clear = is(sure.clear);
                self.list.push(Candidate { slot, corners, side, clear, cut, parent, owner: NOWHERE });
            }
        }
    }

    /// Gives each patch a number, then each triangle that is open; calls back with the latter. Returns how many patches
    /// there are.
    pub(super) fn name_owners(&mut self, mut open: impl FnMut(&Candidate)) -> usize {
        let mut patches = 0;
        for i in 0..self.list.len() {
            if self.list[i].side == 0 {
                continue;
            }
            let root = self.root(i as u32) as usize;
            if self.list[root].owner == NOWHERE {
                self.list[root].owner = patches;
                patches += 1;
            }
            self.list[i].owner = self.list[root].owner;
        }
        for (owner, candidate) in (patches..).zip(self.list.iter_mut().filter(|c| c.side == 0)) {
            candidate.owner = owner;
            open(candidate);
        }
        patches as usize
    }

    /// Names every edge at which the number of layers may change, with triangles cut at a plane.
    pub(super) fn edges(&self, clip: Option<&Clip>, mut put: impl FnMut(Edge)) {
        for Kept { candidate, side: k, beyond } in &self.kept {
            let one = &self.list[*candidate as usize];
            let ends = [one.corners[*k], one.corners[(k + 1) % 3]];
            let ends = if one.cut { clip.and_then(|clip| clip.before(ends)) } else { Some(ends) };
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
        for one in self.list.iter().filter(|c| c.cut) {
            if let Some(ends) = clip.and_then(|clip| clip.across(&one.corners)) {
                put(Edge { ends, owners: [one.owner; 2], sides: [one.side, 0], open: false });
            }
        }
    }

    fn index(&mut self) {
        let size = (2 * self.list.len()).next_power_of_two();
        self.table.clear();
        self.table.resize(size, (NOWHERE, 0));
        for (i, candidate) in self.list.iter().enumerate() {
            let mut at = spot(candidate.slot, size);
            while self.table[at].0 != NOWHERE {
                at = (at + 1) & (size - 1);
            }
            self.table[at] = (candidate.slot, i as u32);
        }
    }

    #[inline(always)]
    fn find(&self, slot: u32) -> Option<usize> {
        let size = self.table.len();
        let mut at = spot(slot, size);
        loop {
            match self.table[at] {
                (found, candidate) if found == slot => return Some(candidate as usize),
                (NOWHERE, _) => return None,
                _ => at = (at + 1) & (size - 1),
            }
        }
    }

    /// Makes patches of neighbours whose common edge changes nothing, and keeps all other edges.
    pub(super) fn join(&mut self, surfaces: &Surfaces) {
        self.index();
        self.kept.clear();
        for i in 0..self.list.len() {
            let Candidate { slot, side, .. } = self.list[i];
            for k in 0..3 {
                let mate = surfaces.mates.of(slot, k);
                let mate = mate.and_then(|mate| Some((self.find(mate.slot)?, mate.opposite)));
                let Some((beyond, reverse)) = mate else {
                    self.kept.push(Kept { candidate: i as u32, side: k, beyond: None });
                    continue;
                };
                // Each edge once.
                if beyond <= i {
                    continue;
                }
                let other = self.list[beyond].side;
                let cancel = if reverse { side == other } else { side == -other };
                if side != 0 && cancel {
                    let (a, b) = (self.root(i as u32), self.root(beyond as u32));
                    self.list[a.max(b) as usize].parent = a.min(b);
                } else {
                    let beyond = Some((beyond as u32, reverse));
                    self.kept.push(Kept { candidate: i as u32, side: k, beyond });
                }
            }
        }
    }

    /// Of a patch, with the ways to it halved (Tarjan and van Leeuwen 1984).
    fn root(&mut self, mut i: u32) -> u32 {
        while self.list[i as usize].parent != i {
            let up = self.list[i as usize].parent;
            self.list[i as usize].parent = self.list[up as usize].parent;
            i = up;
        }
        i
    }
}

/// Where a slot is looked for first (Knuth's multiplicative hash).
#[inline(always)]
fn spot(slot: u32, size: usize) -> usize {
    ((u64::from(slot.wrapping_mul(0x9e37_79b9)) * size as u64) >> 32) as usize
}
