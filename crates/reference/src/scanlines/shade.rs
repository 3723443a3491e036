//! Whether one patch of surface hides the whole light from a whole group of receivers.
//!
//! A ray from the middle of the group to the middle of the light hits a triangle. As long as an edge of the patch may
//! cross the light from any of the receivers, the triangle beyond that edge joins it. If no such edge is left, the
//! patch covers all of the light or nothing of it, the same from everywhere in the group, and the ray says which.

use super::blocks::{Block, Blocks};
use super::clip::upright;
use super::eight::{Eight, LANES};
use super::facing::Standpoint;
use crate::aim::{Aim, Outline};
use crate::rays::LIGHT_GAP;
use crate::surfaces::{Line, Surfaces};
use glam::{DVec3, Vec3};
use pulp::{Arch, Simd, WithSimd};

/// Triangles of a patch, at most, and triangles on the ray that are tried.
const LARGEST: usize = 48;
const TRIED: usize = 3;

/// What a dozen roundings of 2^-24 in products of three lengths, each a sum of three coordinates, leave in doubt.
const ROUNDING: f32 = 2e-6;

/// The patch that was found last, and what finding one needs.
#[derive(Default)]
pub(super) struct Shade {
    patch: Vec<u32>,
    /// On which side the receivers are.
    behind: Vec<bool>,
    wave: Blocks,
    next: Vec<(u32, bool)>,
}

/// A light from all corners of a box around receivers, one in each lane.
struct Pyramids {
    place: [Eight; 3],
    axis: [Eight; 3],
    u: Vec3,
    v: Vec3,
    round: bool,
    /// Normals of the sides, turned outwards.
    sides: [[Eight; 3]; 4],
    /// Sum of the light's coordinates without signs, at most.
    size: Eight,
}

/// Compiled for wide registers by itself.
struct Spread<'a> {
    shade: &'a mut Shade,
    surfaces: &'a Surfaces,
    standpoint: &'a Standpoint,
    pyramids: &'a Pyramids,
    seed: u32,
}

impl WithSimd for Spread<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        self.shade.spread(self.surfaces, self.standpoint, self.pyramids, self.seed)
    }
}

impl Shade {
    pub(super) fn hides(&mut self, surfaces: &Surfaces, standpoint: &Standpoint, aim: &Aim) -> bool {
        let middle = standpoint.centre().as_dvec3();
        // A box may reach beyond a flat light's plane although no receiver in it does.
        let up = upright(aim);
        if aim.nearness()[0] != 0.0
            && standpoint.corners().iter().any(|c| up.dot(aim.axis + middle - c.as_dvec3()) <= 0.0)
        {
            return false;
        }
        let length = aim.axis.length();
        let end = if aim.nearness()[0] == 0.0 { f64::INFINITY } else { length * (1.0 - LIGHT_GAP) };
        let line = Line { origin: middle, direction: aim.axis / length, range: [0.0, end] };
        let pyramids = Pyramids::new(standpoint, aim);
        // Most often the neighbours' patch; otherwise the largest triangles on the ray.
        let neighbours = self.patch.iter().take(LANES).find(|&&slot| surfaces.crosses(&line, slot)).copied();
        if let Some(seed) = neighbours
            && Arch::new().dispatch(Spread { shade: self, surfaces, standpoint, pyramids: &pyramids, seed })
        {
            return true;
        }
        let mut hits = Vec::new();
        surfaces.crossing(&line, |slot| {
            let [a, b, c] = surfaces.corners_f64(slot);
            hits.push((slot, (b - a).cross(c - a).length_squared()));
        });
        hits.sort_unstable_by(|a, b| b.1.total_cmp(&a.1));
        hits.into_iter().take(TRIED).any(|(seed, _)| {
            Arch::new().dispatch(Spread { shade: self, surfaces, standpoint, pyramids: &pyramids, seed })
        })
    }

    /// Grows a patch from one triangle.
    #[inline(always)]
    fn spread(
        &mut self,
        surfaces: &Surfaces,
        standpoint: &Standpoint,
        pyramids: &Pyramids,
        seed: u32,
    ) -> bool {
        if surfaces.is_cut(seed) {
            return false;
        }
        self.patch.clear();
        self.behind.clear();
        self.patch.push(seed);
        let mut done = 0;
        while done < self.patch.len() {
            if self.patch.len() > LARGEST {
                return false;
            }
            // A wave of up to eight triangles.
            let wave = done..self.patch.len().min(done + LANES);
            done = wave.end;
            self.wave.clear();
            for &slot in &self.patch[wave.clone()] {
                self.wave.push(slot, &surfaces.corners[slot as usize]);
            }
            let Some(block) = self.wave.blocks.first() else { return false };
            let sure = standpoint.sure(block);
            let all = sure.nearer & sure.clear & sure.sided;
            if !all & block.used() != 0 {
                return false;
            }
            self.next.clear();
            for lane in 0..wave.len() {
                let behind = sure.behind >> lane & 1 != 0;
                if wave.start + lane == 0 {
                    self.behind.push(behind);
                } else if self.behind[wave.start + lane] != behind {
                    // A fold: before the light the patch turns its other side to the receivers.
                    return false;
                }
                if !cross(block, lane, (surfaces, pyramids), behind, &mut self.next) {
                    return false;
                }
            }
            for &(slot, behind) in &self.next {
                match self.patch.iter().position(|&other| other == slot) {
                    Some(at) if self.behind[at] != behind => return false,
                    Some(_) => {}
                    None => {
                        self.patch.push(slot);
                        self.behind.push(behind);
                    }
                }
            }
        }
        true
    }
}

/// Names the triangles beyond those edges of one that may cross the light, and on which side of them the receivers
/// must be; false if there is none.
#[inline(always)]
fn cross(
    block: &Block,
    lane: usize,
    (surfaces, pyramids): (&Surfaces, &Pyramids),
    behind: bool,
    next: &mut Vec<(u32, bool)>,
) -> bool {
    let corners = block.triangle(lane);
    let seen = [pyramids.from(corners[0]), pyramids.from(corners[1]), pyramids.from(corners[2])];
    for k in 0..3 {
        if pyramids.misses(&seen[k], &seen[(k + 1) % 3]) {
            continue;
        }
        match surfaces.mates.of(block.slots[lane], k) {
            Some(mate) if !surfaces.is_cut(mate.slot) => next.push((mate.slot, behind == mate.opposite)),
            _ => return false,
        }
    }
    true
}

impl Pyramids {
    fn new(standpoint: &Standpoint, aim: &Aim) -> Self {
        let middle = standpoint.centre().as_dvec3();
        let sun = aim.nearness()[0] == 0.0;
        let zero = [Eight::all(0.0); 3];
        let mut new = Self {
            place: zero,
            axis: zero,
            u: aim.u.as_vec3(),
            v: aim.v.as_vec3(),
            round: aim.outline == Outline::Disk,
            sides: [zero; 4],
            size: Eight::all(0.0),
        };
        let (width, height) = (aim.u.abs().element_sum(), aim.v.abs().element_sum());
        for (lane, place) in standpoint.corners().into_iter().enumerate() {
            let axis = if sun { aim.axis } else { aim.axis + middle - place.as_dvec3() };
            let sides: [[DVec3; 2]; 4] =
                [[axis + aim.u, aim.v], [aim.v, axis - aim.u], [aim.u, axis + aim.v], [axis - aim.v, aim.u]];
            let set = |into: &mut [Eight; 3], value: Vec3| {
                for i in 0..3 {
                    into[i].0[lane] = value[i];
                }
            };
            set(&mut new.place, place);
            set(&mut new.axis, axis.as_vec3());
            for (into, [p, q]) in new.sides.iter_mut().zip(sides) {
                let normal = p.cross(q).normalize_or_zero();
                let outwards = if normal.dot(axis) > 0.0 { -normal } else { normal };
                set(into, outwards.as_vec3());
            }
            new.size.0[lane] = (axis.abs().element_sum() + width + height) as f32;
        }
        new
    }

    #[inline(always)]
    fn from(&self, corner: Vec3) -> [Eight; 3] {
        let [x, y, z] = self.place;
        [Eight::all(corner.x) - x, Eight::all(corner.y) - y, Eight::all(corner.z) - z]
    }

    /// Whether an edge is off the light from every corner, for the same reason from all: then it is from everywhere
    /// between them, because heights over planes through a receiver, an edge and a point are linear in each.
    #[inline(always)]
    fn misses(&self, a: &[Eight; 3], b: &[Eight; 3]) -> bool {
        let sizes = [a[0].abs() + a[1].abs() + a[2].abs(), b[0].abs() + b[1].abs() + b[2].abs()];
        let doubt = Eight::all(ROUNDING) * sizes[0].max(sizes[1]);
        for side in &self.sides {
            let nearer = dot(side, a).min(dot(side, b));
            if doubt.below(nearer).bits() == 0xff {
                return true;
            }
        }
        let m = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let middle = dot(&self.axis, &m);
        let u = Eight::all(self.u.x) * m[0] + Eight::all(self.u.y) * m[1] + Eight::all(self.u.z) * m[2];
        let v = Eight::all(self.v.x) * m[0] + Eight::all(self.v.y) * m[1] + Eight::all(self.v.z) * m[2];
        let reach = if self.round { (u * u + v * v).sqrt() } else { u.abs() + v.abs() };
        let reach = reach + Eight::all(ROUNDING) * sizes[0] * sizes[1] * self.size;
        reach.below(middle).bits() == 0xff || reach.below(-middle).bits() == 0xff
    }
}

#[inline(always)]
fn dot(a: &[Eight; 3], b: &[Eight; 3]) -> Eight {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
