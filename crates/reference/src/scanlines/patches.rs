//! What is between a group of receivers and the light, as the edges where the number of layers changes.
//!
//! A sample is hidden where at least one triangle covers it. Seen along a row of samples, a triangle adds a layer
//! where the row enters it and takes one away where it leaves it; at an edge between two neighbours that face the
//! receiver with the same side the two cancel, exactly, because both edges are the same two places. What is left
//! are silhouettes and borders (as in soft shadow volumes, Laine et al. 2005, section 3), and a wall of ten
//! thousand triangles is as simple as its outline.

use super::blocks::{Block, Blocks};
use super::candidates::{Candidates, Edge};
use super::edges::{EdgeList, Seen};
use super::eight::LANES;
use super::facing::Standpoint;
use super::frame::Frame;
use crate::receiver::Receiver;
use crate::surfaces::Surfaces;
use glam::Vec3;

/// Triangles that face all receivers with the same side, connected, and triangles by themselves.
#[derive(Default)]
pub(super) struct Patches {
    edges: EdgeList,
    /// Triangles whose side depends on the receiver: an owner each, after the patches.
    open: Blocks,
    /// A bit for each open triangle of a block that is surely above all receivers' horizons.
    clear: Vec<u32>,
    patches: usize,
    /// Of each owner: 1, or what an open one is to the receiver: 1, -1, or 0 where it does not count.
    sides: Vec<i8>,
    /// Of each owner, at a receiver: layers at the light's middle, and whether its edges may cross the light.
    layers: Vec<i32>,
    touched: Vec<bool>,
    /// The patch that hid the light from a neighbour, and its edges alone.
    shade: Option<u32>,
    shade_edges: EdgeList,
    /// What a receiver sees of the edges.
    pub(super) seen: Vec<Seen>,
    candidates: Candidates,
    past: Past,
}

/// What a receiver sees of the light past the patches.
#[derive(Clone, Copy, Default)]
pub(super) enum Past {
    /// Nothing is before it.
    #[default]
    Lit,
    /// One patch hides all of it, or all of them together a constant number of layers deep.
    Hidden,
    /// Edges cross it.
    Crossed,
}

impl Patches {
    /// Edges, in all their lanes.
    pub(super) fn len(&self) -> usize {
        LANES * self.edges.blocks.len()
    }

    /// What the receiver that looked last sees.
    pub(super) fn past(&self) -> Past {
        self.past
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
        let Self { candidates, edges, open, clear, .. } = self;
        candidates.take(standpoint, all, rest);
        candidates.join(surfaces);
        open.clear();
        clear.clear();
        self.patches = candidates.name_owners(all, |candidate| {
            let lane = open.push(candidate.slot, &candidate.corners);
            if lane == 0 {
                clear.push(0);
            }
            if let Some(last) = clear.last_mut() {
                *last |= u32::from(candidate.clear) << lane;
            }
        });
        edges.clear();
        candidates.edges(all, standpoint, |edge| edges.push(&edge));
        self.sides.clear();
        self.sides.resize(self.patches + self.open.blocks.len() * LANES, 1);
        self.shade = None;
    }

    /// Looks at the light from one receiver.
    #[inline(always)]
    pub(super) fn look(&mut self, receiver: &Receiver, frame: &Frame) -> Past {
        self.past = if self.edges.blocks.is_empty() {
            Past::Lit
        } else if self.shaded(frame) {
            Past::Hidden
        } else {
            self.cross(receiver, frame)
        };
        self.past
    }

    /// Whether the patch that hid the light from a neighbour hides it here.
    #[inline(always)]
    fn shaded(&self, frame: &Frame) -> bool {
        let (mut layers, mut touching) = (0, 0);
        for edges in &self.shade_edges.blocks {
            let seen = edges.see(frame);
            touching |= seen.touching;
            layers += balance(&seen, &edges.sides[0]);
        }
        self.shade.is_some() && touching == 0 && layers != 0
    }

    #[inline(always)]
    fn cross(&mut self, receiver: &Receiver, frame: &Frame) -> Past {
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
        for edges in &self.edges.blocks {
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
                    self.layers[owner] += i32::from(rising * edges.sides[i][lane] * self.sides[owner]);
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
            false if self.layers.iter().sum::<i32>() != 0 => Past::Hidden,
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
        for edges in &self.edges.blocks {
            for lane in 0..LANES {
                for i in 0..2 {
                    let sides = [edges.sides[i][lane], 0];
                    if edges.owners[i][lane] as usize == owner && sides[0] != 0 {
                        let (ends, owners) = (edges.ends(lane), [owner as u32; 2]);
                        self.shade_edges.push(&Edge { ends, owners, sides, open: false });
                    }
                }
            }
        }
    }
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
