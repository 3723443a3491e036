//! What is between a group of receivers and the light, as the edges where the number of layers changes.
//!
//! A sample is hidden where at least one triangle covers it. Seen along a row of samples, a triangle adds a layer
//! where the row enters it and takes one away where it leaves it; at an edge between two neighbours that face the
//! receiver with the same side the two cancel, exactly, because both edges are the same two places. What is left
//! are silhouettes and borders (as in soft shadow volumes, Laine et al. 2005, section 3), and a wall of ten
//! thousand triangles is as simple as its outline.

use super::blocks::{Block, Blocks};
use super::edges::{Edges, Seen};
use super::eight::LANES;
use super::facing::{Clip, Standpoint};
use super::frame::Frame;
use crate::receiver::Receiver;
use crate::surfaces::Surfaces;
use glam::Vec3;

/// A triangle without edges here.
const NOWHERE: u32 = u32::MAX;

/// Triangles that face all receivers with the same side, connected, and triangles by themselves.
#[derive(Default)]
pub(super) struct Patches {
    edges: Vec<Edges>,
    filled: usize,
    /// Triangles whose side depends on the receiver: an owner each, after the patches.
    open: Blocks,
    /// A bit for each open triangle of a block that is surely above all receivers' horizons.
    clear: Vec<u32>,
    patches: usize,
    /// Of each owner: 1, or what an open one is to the receiver: 1, -1, or 0 where it does not count.
    sides: Vec<i8>,
    /// Of each owner, at a receiver: layers at the light's middle, and whether its edges may cross the light.
    layers: Vec<i16>,
    touched: Vec<bool>,
    /// The patch that hid the light from a neighbour, and its edges alone.
    shade: Option<u32>,
    shade_edges: Vec<Edges>,
    /// What a receiver sees of the edges.
    pub(super) seen: Vec<Seen>,
    work: Work,
}

/// What is known of one candidate.
#[derive(Clone, Copy)]
struct Candidate {
    slot: u32,
    corners: [Vec3; 3],
    /// 1 or -1; 0 where it depends on the receiver.
    side: i8,
    clear: bool,
    /// Whether it has to be cut before all receivers.
    cut: bool,
    /// Another of the same patch, or itself.
    parent: u32,
    owner: u32,
}

#[derive(Default)]
struct Work {
    candidates: Vec<Candidate>,
    /// Slots and their candidates, open addressing.
    table: Vec<(u32, u32)>,
    /// Candidate, its side, and the candidate beyond.
    kept: Vec<(u32, u32, u32)>,
}

/// What a receiver sees of the light past the patches.
pub(super) enum Past {
    /// Nothing is before it.
    Lit,
    /// One patch hides all of it, or all of them together a constant number of layers deep.
    Hidden,
    /// Edges cross it.
    Crossed,
}

impl Patches {
    pub(super) fn is_empty(&self) -> bool {
        self.edges.is_empty()
    }

    /// Sorts the candidates of a group: those that are surely between all of its receivers and the light become
    /// patches; the others stay behind in `rest`.
    #[inline(always)]
    pub(super) fn sort(
        &mut self,
        surfaces: &Surfaces,
        standpoint: Option<&Standpoint>,
        (all, rest): (&Blocks, &mut Blocks),
    ) {
        self.edges.clear();
        self.filled = 0;
        self.open.clear();
        self.clear.clear();
        self.shade = None;
        self.work.candidates.clear();
        rest.clear();
        let Some(standpoint) = standpoint else {
            for block in &all.blocks {
                for lane in 0..block.used().count_ones() as usize {
                    rest.push(block.slots[lane], &block.triangle(lane));
                }
            }
            return;
        };
        for block in &all.blocks {
            let sure = standpoint.sure(block);
            for lane in 0..block.used().count_ones() as usize {
                if sure.never >> lane & 1 != 0 {
                    continue;
                }
                let (slot, corners) = (block.slots[lane], block.triangle(lane));
                if sure.clear >> lane & 1 == 0 && standpoint.skips(&corners) {
                    continue;
                }
                let front = sure.front >> lane & 1 != 0;
                let cut = standpoint.clip().is_some() && (sure.clear & sure.sided) >> lane & 1 != 0;
                if sure.nearer >> lane & 1 == 0 || !(front || cut) {
                    rest.push(slot, &corners);
                    continue;
                }
                let clear = sure.clear >> lane & 1 != 0;
                let side = match (clear && sure.sided >> lane & 1 != 0, sure.behind >> lane & 1 != 0) {
                    (false, _) => 0,
                    (true, false) => 1,
                    (true, true) => -1,
                };
                let parent = self.work.candidates.len() as u32;
                let cut = !front;
                let candidate = Candidate { slot, corners, side, clear, cut, parent, owner: NOWHERE };
                self.work.candidates.push(candidate);
            }
        }
        self.work.index();
        self.work.join(surfaces);
        self.name_owners();
        self.keep_edges(standpoint.clip());
    }

    fn name_owners(&mut self) {
        let mut patches = 0;
        for i in 0..self.work.candidates.len() {
            if self.work.candidates[i].side == 0 {
                continue;
            }
            let root = self.work.root(i as u32) as usize;
            if self.work.candidates[root].owner == NOWHERE {
                self.work.candidates[root].owner = patches;
                patches += 1;
            }
            self.work.candidates[i].owner = self.work.candidates[root].owner;
        }
        self.patches = patches as usize;
        let open = self.work.candidates.iter_mut().filter(|c| c.side == 0);
        for (open, candidate) in open.enumerate() {
            candidate.owner = patches + open as u32;
            self.open.push(candidate.slot, &candidate.corners);
            let lane = open % LANES;
            if lane == 0 {
                self.clear.push(0);
            }
            if let Some(last) = self.clear.last_mut() {
                *last |= u32::from(candidate.clear) << lane;
            }
        }
        self.sides.clear();
        self.sides.resize(self.patches + self.open.blocks.len() * LANES, 1);
    }

    fn keep_edges(&mut self, clip: Option<Clip>) {
        for &(at, k, beyond) in &self.work.kept {
            let one = &self.work.candidates[at as usize];
            let mut ends = [one.corners[k as usize], one.corners[(k as usize + 1) % 3]];
            if one.cut
                && let Some(clip) = clip
            {
                let [from, to, _] = clip.heights(&[ends[0], ends[1], ends[1]]);
                match (from > 0.0, to > 0.0) {
                    (true, true) => {}
                    (true, false) => ends[1] = clip.between(ends[0], ends[1]),
                    (false, true) => ends[0] = clip.between(ends[0], ends[1]),
                    (false, false) => continue,
                }
            }
            let unless_open = |side: i8| if side == 0 { 1 } else { side };
            let mut owners = [one.owner; 2];
            let mut sides = [unless_open(one.side), 0];
            let mut open = one.side == 0;
            if beyond != NOWHERE {
                let (beyond, reverse) = (beyond >> 1, beyond & 1 != 0);
                let other = &self.work.candidates[beyond as usize];
                owners[1] = other.owner;
                sides[1] = if reverse { -unless_open(other.side) } else { unless_open(other.side) };
                open |= other.side == 0;
            }
            put(&mut self.edges, &mut self.filled, (ends, owners, sides, open));
        }
        // What is cut has an edge there.
        let Some(clip) = clip else { return };
        for one in self.work.candidates.iter().filter(|c| c.cut) {
            let heights = clip.heights(&one.corners);
            let (mut from, mut to) = (None, None);
            for k in 0..3 {
                let next = (k + 1) % 3;
                let place = || clip.between(one.corners[k], one.corners[next]);
                match (heights[k] > 0.0, heights[next] > 0.0) {
                    (true, false) => from = Some(place()),
                    (false, true) => to = Some(place()),
                    _ => {}
                }
            }
            if let (Some(from), Some(to)) = (from, to) {
                put(&mut self.edges, &mut self.filled, ([from, to], [one.owner; 2], [one.side, 0], false));
            }
        }
    }

    /// Looks at the light from one receiver.
    #[inline(always)]
    pub(super) fn look(&mut self, receiver: &Receiver, frame: &Frame) -> Past {
        if self.shade.is_some() {
            let (mut layers, mut touching) = (0, 0);
            for edges in &self.shade_edges {
                let seen = edges.see(frame);
                touching |= seen.touching;
                layers += balance(&seen, &edges.sides[0]);
            }
            if touching == 0 && layers != 0 {
                return Past::Hidden;
            }
        }
        let sides = self.sides[self.patches..].as_chunks_mut::<LANES>().0;
        for ((block, &clear), sides) in self.open.blocks.iter().zip(&self.clear).zip(sides) {
            let faces = block.face(frame);
            let sure = faces.sure & (faces.clear | clear);
            for lane in 0..LANES {
                sides[lane] = 1 - 2 * (faces.behind >> lane & 1) as i8;
            }
            let mut unsure = !sure & block.used();
            while unsure != 0 {
                let lane = unsure.trailing_zeros() as usize;
                unsure &= unsure - 1;
                sides[lane] = side(receiver, block, lane);
            }
        }
        self.layers.clear();
        self.layers.resize(self.sides.len(), 0);
        self.touched.clear();
        self.touched.resize(self.sides.len(), false);
        self.seen.clear();
        let mut crossed = false;
        for edges in &self.edges {
            let mut seen = edges.see(frame);
            let mut open = edges.open;
            while open != 0 {
                let lane = open.trailing_zeros() as usize;
                open &= open - 1;
                let side = |i: usize| edges.sides[i][lane] * self.sides[edges.owners[i][lane] as usize];
                seen.weight[lane] = side(0) + side(1);
            }
            let mut touching = seen.touching;
            while touching != 0 {
                let lane = touching.trailing_zeros() as usize;
                touching &= touching - 1;
                crossed |= seen.weight[lane] != 0;
                for owners in &edges.owners {
                    self.touched[owners[lane] as usize] = true;
                }
            }
            let mut passing = seen.passing;
            while passing != 0 {
                let lane = passing.trailing_zeros() as usize;
                passing &= passing - 1;
                let rising = if seen.rising >> lane & 1 != 0 { 1 } else { -1 };
                for i in 0..2 {
                    let owner = edges.owners[i][lane] as usize;
                    self.layers[owner] += i16::from(rising * edges.sides[i][lane] * self.sides[owner]);
                }
            }
            self.seen.push(seen);
        }
        let whole = self.layers.iter().zip(&self.touched).position(|(&n, &touched)| n != 0 && !touched);
        if let Some(owner) = whole {
            self.shaded_by(owner);
            return Past::Hidden;
        }
        match crossed {
            true => Past::Crossed,
            false if self.layers.iter().sum::<i16>() != 0 => Past::Hidden,
            false => Past::Lit,
        }
    }

    /// Asks this patch first at the next receiver.
    fn shaded_by(&mut self, owner: usize) {
        if owner >= self.patches || self.shade == Some(owner as u32) {
            return;
        }
        self.shade = Some(owner as u32);
        self.shade_edges.clear();
        let mut filled = 0;
        for edges in &self.edges {
            for i in 0..2 {
                for from in 0..LANES {
                    if edges.owners[i][from] as usize != owner || edges.sides[i][from] == 0 {
                        continue;
                    }
                    let lane = filled % LANES;
                    if lane == 0 {
                        self.shade_edges.push(Edges::default());
                    }
                    if let Some(last) = self.shade_edges.last_mut() {
                        last.copy(lane, edges, from, i);
                    }
                    filled += 1;
                }
            }
        }
    }
}

/// Adds an edge: ends, owners, sides, whether one of them is open.
fn put(
    edges: &mut Vec<Edges>,
    filled: &mut usize,
    (ends, owners, sides, open): ([Vec3; 2], [u32; 2], [i8; 2], bool),
) {
    let lane = *filled % LANES;
    if lane == 0 {
        edges.push(Edges::default());
    }
    if let Some(last) = edges.last_mut() {
        last.set(lane, ends, owners, sides, open);
    }
    *filled += 1;
}

/// Layers that edges with one owner each make at the light's middle.
#[inline(always)]
fn balance(seen: &Seen, sides: &[i8; LANES]) -> i32 {
    let (mut passing, mut layers) = (seen.passing, 0);
    while passing != 0 {
        let lane = passing.trailing_zeros() as usize;
        passing &= passing - 1;
        let side = i32::from(sides[lane]);
        layers += if seen.rising >> lane & 1 != 0 { side } else { -side };
    }
    layers
}

/// On which side of an open triangle a receiver is, or 0 where it does not count.
fn side(receiver: &Receiver, block: &Block, lane: usize) -> i8 {
    let corners = block.triangle(lane);
    if receiver.skips(block.slots[lane], &corners) {
        return 0;
    }
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let height: f64 = (b - a).cross(c - a).dot(a - receiver.position);
    i8::from(height > 0.0) - i8::from(height < 0.0)
}

impl Work {
    fn index(&mut self) {
        let size = (2 * self.candidates.len()).next_power_of_two();
        self.table.clear();
        self.table.resize(size, (NOWHERE, 0));
        for (i, candidate) in self.candidates.iter().enumerate() {
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
    fn join(&mut self, surfaces: &Surfaces) {
        self.kept.clear();
        for i in 0..self.candidates.len() {
            let Candidate { slot, side, .. } = self.candidates[i];
            for k in 0..3 {
                let mate = surfaces.mates.of(slot, k);
                let Some((mate, beyond)) = mate.and_then(|mate| Some((mate, self.find(mate.slot)?))) else {
                    self.kept.push((i as u32, k as u32, NOWHERE));
                    continue;
                };
                if beyond <= i {
                    continue;
                }
                let other = &self.candidates[beyond];
                let reverse = mate.opposite;
                let sides = if reverse { -other.side } else { other.side };
                if side != 0 && other.side != 0 && side + sides == 0 {
                    let (a, b) = (self.root(i as u32), self.root(beyond as u32));
                    self.candidates[a.max(b) as usize].parent = a.min(b);
                } else {
                    self.kept.push((i as u32, k as u32, (beyond as u32) << 1 | u32::from(reverse)));
                }
            }
        }
    }

    fn root(&mut self, mut i: u32) -> u32 {
        while self.candidates[i as usize].parent != i {
            let up = self.candidates[i as usize].parent;
            self.candidates[i as usize].parent = self.candidates[up as usize].parent;
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
