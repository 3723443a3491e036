//! Neighbouring pixels share one walk of the tree.
//!
//! What is found is what `Surfaces::closest` finds ray by ray, bit by bit. A tile keeps, per pixel, the surface
//! nearest so far and its nearness 1/t. A surface takes the place if the f32 functions of `sheet` leave no doubt
//! about it; else the f64 test decides. Where two are closer to each other than [`APART`], or where `finish` does
//! not confirm what was found, the pixel goes its own way through the tree.
//!
//! Why that suffices: no surface that the f64 test finds is passed over unless something that takes its place seems
//! nearer by twice [`APART`], since `sheet` never takes a surface for farther than it is. Whatever seemed nearest
//! only gives way to what seems nearer still. So once `finish` has found the last one's nearness right to one
//! [`APART`], all others are farther by nearly one, in whatever order they came.

use super::camera::{CameraRays, Lines};
use super::frustum::{Frustum, MISSED};
use super::sheet::{Aspect, Sheet, Sight};
use crate::scanlines::{Eight, LANES};
use crate::surfaces::{Surfaces, intersect};

/// Rows of a tile; its columns are the lanes.
pub(super) const ROWS: usize = 8;
/// From the middle of a tile to its first column, and to its first row.
pub(super) const HALF: [f64; 2] = [0.5 * (LANES - 1) as f64, 0.5 * (ROWS - 1) as f64];
/// No surface.
pub(super) const NONE: u32 = u32::MAX;
/// Of nearness, in parts: what differs by less has no order here. Eight times the slack in f32 of a surface whose
/// nearness does not vary within the tile.
pub(super) const APART: f32 = 1.0 / (1 << 17) as f32;

/// What is needed for a tile but does not depend on it.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) surfaces: &'a Surfaces,
    pub(super) camera: &'a CameraRays,
    /// Columns and rows of the picture.
    pub(super) size: [u32; 2],
}

pub(super) struct Tile {
    pub(super) lines: [Lines; ROWS],
    /// Nearness of the nearest surface so far, t in lengths of the direction; where there is none, of the far plane.
    pub(super) best: [Eight; ROWS],
    pub(super) slot: [[u32; LANES]; ROWS],
    /// Pixels that go their own way.
    pub(super) doubt: [[bool; LANES]; ROWS],
    /// Of the near plane, at least: what is nearer than this is looked at in f64.
    near: f32,
    /// No pixel needs a surface less near.
    least: f64,
    sight: Sight,
    frustum: Frustum,
}

impl Tile {
    #[inline(always)]
    pub(super) fn new(place: &Place, [x, y]: [u32; 2]) -> Self {
        let Place { surfaces, camera, size } = *place;
        let mut lines = [camera.lines(x, y); ROWS];
        for (row, lines) in lines.iter_mut().enumerate() {
            *lines = camera.lines(x, y + row as u32);
        }
        let sight = Sight {
            eye: camera.eye,
            middle: camera.through(f64::from(x) + 0.5 + HALF[0], f64::from(y) + 0.5 + HALF[1]),
            right: camera.right,
            down: camera.down,
            length: camera.longest,
        };
        let frustum = Frustum::new(camera, &sight, HALF, f64::from(surfaces.extent));
        let mut best = [Eight::all(f32::INFINITY); ROWS];
        let mut near = f32::INFINITY;
        for row in 0..ROWS {
            let Lines { length, near: first, far: last, .. } = &lines[row];
            for k in 0..LANES {
                let inside = x + (k as u32) < size[0] && y + (row as u32) < size[1];
                // A pixel outside of the picture sees nothing.
                let far = (length.0[k] / last.0[k]) as f32 * (1.0 - 4.0 * APART);
                best[row].0[k] = if inside { far } else { f32::INFINITY };
                near = near.min((length.0[k] / first.0[k]) as f32 * (1.0 - 4.0 * APART));
            }
        }
        let (slot, doubt) = ([[NONE; LANES]; ROWS], [[false; LANES]; ROWS]);
        let mut tile = Self { lines, best, slot, doubt, near, least: 0.0, sight, frustum };
        tile.cut();
        tile
    }

    /// Finds the nearest surfaces.
    #[inline(always)]
    pub(super) fn walk(&mut self, surfaces: &Surfaces, open: &mut Vec<(u32, f32)>) {
        let nodes = &surfaces.bvh.nodes[..];
        open.clear();
        open.push((0, self.frustum.near(&nodes[0])));
        while let Some((index, near)) = open.pop() {
            if near == MISSED || self.frustum.is_beyond(near) {
                continue;
            }
            let mut node = &nodes[index as usize];
            loop {
                let first = node.first_index;
                if node.is_leaf() {
                    self.leaf(surfaces, first..first + node.prim_count);
                    break;
                }
                let [left, right] = [&nodes[first as usize], &nodes[first as usize + 1]];
                let nears = [self.frustum.near(left), self.frustum.near(right)];
                let swap = nears[1] > nears[0];
                let (nearer, farther) = if swap { (right, first) } else { (left, first + 1) };
                if nears[0].max(nears[1]) == MISSED {
                    break;
                }
                if nears[0].min(nears[1]) != MISSED {
                    open.push((farther, nears[0].min(nears[1])));
                }
                node = nearer;
            }
        }
    }

    #[inline(always)]
    fn leaf(&mut self, surfaces: &Surfaces, slots: std::ops::Range<u32>) {
        let mut changed = false;
        for slot in slots {
            if self.frustum.misses(&surfaces.corners[slot as usize]) {
                continue;
            }
            changed |= match Aspect::new(&self.sight, surfaces.corners_f64(slot), self.least) {
                Aspect::Nowhere => false,
                Aspect::Here(sheet) => self.cover(surfaces, slot, &sheet),
                Aspect::Unknown => self.all(surfaces, slot),
            };
        }
        if changed {
            self.cut();
        }
    }

    /// Looks at a triangle through all pixels. Whether one found it.
    #[inline(always)]
    fn cover(&mut self, surfaces: &Surfaces, slot: u32, sheet: &Sheet) -> bool {
        let mut steps = Eight::all(0.0);
        for k in 0..LANES {
            steps.0[k] = k as f32 - 0.5 * (LANES - 1) as f32;
        }
        let [mut a, mut b, mut c, mut near] = [
            steps * Eight::all(sheet.across[0]) + Eight::all(sheet.at[0]),
            steps * Eight::all(sheet.across[1]) + Eight::all(sheet.at[1]),
            steps * Eight::all(sheet.across[2]) + Eight::all(sheet.at[2]),
            steps * Eight::all(sheet.across[3]) + Eight::all(sheet.at[3]),
        ];
        let down = [
            Eight::all(sheet.down[0]),
            Eight::all(sheet.down[1]),
            Eight::all(sheet.down[2]),
            Eight::all(sheet.down[3]),
        ];
        let whole = !surfaces.is_cut(slot);
        let mut changed = false;
        for row in 0..ROWS {
            let least = a.min(b).min(c);
            let raised = near * Eight::all(1.0 + 2.0 * APART);
            let hit = least.below(Eight::all(0.0)).or(raised.below(self.best[row])).not();
            if hit.any() {
                let beaten = self.best[row] * Eight::all(1.0 + 2.0 * APART);
                let sure = Eight::all(sheet.sure)
                    .below(least)
                    .and(beaten.below(near))
                    .and(near.below(Eight::all(self.near)));
                if whole && sure.any() {
                    self.best[row] = sure.pick(near, self.best[row]);
                    self.slot[row] = sure.pick_words(slot, self.slot[row]);
                    changed = true;
                }
                let open = if whole { hit.and(sure.not()) } else { hit };
                if open.any() {
                    changed |= self.settle(surfaces, (row, open.bits()), slot);
                }
            }
            (a, b, c, near) = (a + down[0], b + down[1], c + down[2], near + down[3]);
        }
        changed
    }

    /// The same in f64.
    #[inline(never)]
    fn all(&mut self, surfaces: &Surfaces, slot: u32) -> bool {
        let mut changed = false;
        for row in 0..ROWS {
            changed |= self.settle(surfaces, (row, (1 << LANES) - 1), slot);
        }
        changed
    }

    /// Looks at a triangle through some pixels of a row, in f64.
    #[inline(never)]
    fn settle(&mut self, surfaces: &Surfaces, (row, lanes): (usize, u32), slot: u32) -> bool {
        let mut changed = false;
        for k in (0..LANES).filter(|k| lanes >> k & 1 == 1) {
            let line = self.lines[row].line(self.sight.eye, k);
            let Some((distance, along)) = intersect(&line, surfaces.corners_f64(slot)) else { continue };
            if distance >= line.range[0] && distance < line.range[1] && surfaces.is_there(slot, along) {
                let near = (self.lines[row].length.0[k] / distance) as f32;
                let best = self.best[row].0[k];
                // At the eye all surfaces are alike.
                self.doubt[row][k] |= near.is_infinite();
                if self.slot[row][k] == NONE || near > best * (1.0 + 3.0 * APART) {
                    self.best[row].0[k] = near.max(best);
                    self.slot[row][k] = slot;
                    changed = true;
                } else if near >= best * (1.0 - 3.0 * APART) {
                    self.doubt[row][k] = true;
                }
            }
        }
        changed
    }

    /// Finds how far it is worth to look.
    #[inline(always)]
    fn cut(&mut self) {
        let mut least = self.best[0];
        for row in 1..ROWS {
            least = least.min(self.best[row]);
        }
        let mut lowest = f32::INFINITY;
        for k in 0..LANES {
            lowest = lowest.min(least.0[k]);
        }
        self.least = f64::from(lowest) * f64::from(1.0 - 4.0 * APART);
        self.frustum.end(1.0 / self.least);
    }
}
