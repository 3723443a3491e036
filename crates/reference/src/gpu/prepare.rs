//! What the host does before each dispatch: which points go to the GPU, and in which company.

use super::Planes;
use crate::Points;
use crate::aim::{Aim, Elevation};
use crate::receiver::Receiver;
use crate::scanlines::spread;
use crate::surfaces::Surfaces;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use umbrage_scene::AreaLight;

/// Receivers that share a list of candidates, at most: a workgroup's threads.
pub(super) const TOGETHER: usize = 64;
/// Groups of more than this many are cut further where they span a cell of the Morton curve wider than this part of
/// the scene's largest coordinate: the few that are left between others would list half of the scene.
const SPREAD: usize = 8;
const WIDEST: u32 = 32;
/// Points that stay together when the others are sorted.
const RUN: usize = 8;
/// How near they lie, in parts of the scene's largest coordinate.
const NEAR: f32 = 1.0 / 64.0;
/// The sine under which a flat light is edge-on, a tenth above the kernels'.
const EDGE_ON: f32 = 2.2e-3;
/// Points that a thread takes at a time.
const CHUNK: usize = 4096;

/// Bits of each coordinate in a Morton key.
const KEY_BITS: u32 = 20;

/// Words of a receiver: the slot of its triangle, and what it sees.
pub(super) const IN_AIR: u32 = 0x0fff_ffff;
pub(super) const BACK: u32 = 0x1000_0000;
pub(super) const ACROSS: u32 = 0x2000_0000;
/// No receiver: the light is below its horizon, V is 0.
pub(super) const BELOW: u32 = 0xffff_ffff;
/// None either: a horizon without a triangle, or a place that is no number: for the CPU.
pub(super) const OTHER: u32 = 0xffff_fffe;

/// Neighbours with the box around them, as `Group` in task.wgsl.
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Group {
    low: [f32; 3],
    pub(super) first: u32,
    high: [f32; 3],
    pub(super) count: u32,
    normal: [f32; 3],
    unused: u32,
}

/// What the host knows of points: a slice of them is prepared while the GPU is at the one before.
pub(super) struct Prepared<'a> {
    surfaces: &'a Surfaces,
    planes: &'a Planes,
    points: &'a Points,
    light: &'a AreaLight,
    elevations: Vec<[Elevation; 2]>,
    /// For each point so far which receiver it is, with [`ACROSS`], or why it is none.
    pub(super) places: Vec<AtomicU32>,
    /// Receivers so far.
    pub(super) count: u32,
    pub(super) groups: Vec<Group>,
}

impl<'a> Prepared<'a> {
    pub(super) fn new(
        (surfaces, planes): (&'a Surfaces, &'a Planes),
        points: &'a Points,
        light: &'a AreaLight,
    ) -> Self {
        let elevations = elevations(surfaces, planes, light);
        let places = Vec::with_capacity(points.len());
        Self { surfaces, planes, points, light, elevations, places, count: 0, groups: Vec::new() }
    }

    /// Prepares the next points. Returns how many receivers they make, of which `receivers` begins with place and word,
    /// neighbours together, and which groups they stand in.
    pub(super) fn next(
        &mut self,
        points: Range<usize>,
        receivers: &mut Vec<[u32; 4]>,
    ) -> (usize, Range<usize>) {
        // Words first, then which receiver has them.
        let start = self.places.len();
        let mut places = std::mem::take(&mut self.places);
        places.par_extend(points.into_par_iter().map(|i| AtomicU32::new(self.word(i))));
        let extent = self.surfaces.extent;
        let mut runs: Vec<Run> = places[start..]
            .par_chunks_mut(CHUNK)
            .enumerate()
            .flat_map_iter(|(chunk, words)| runs(self.points, words, (start + chunk * CHUNK, extent)))
            .collect();
        runs.par_sort_unstable_by_key(|run| (run.key, run.first));
        let companies = split(&runs);
        let all = count(&runs);
        if receivers.len() < all {
            receivers.resize(all, [0; 4]);
        }
        let (mut left, mut first) = (&mut receivers[..all], self.count);
        let mut desks = Vec::with_capacity(companies.len());
        for company in companies {
            let runs = &runs[company];
            let count = count(runs);
            desks.push((runs, first, left.split_off_mut(..count).unwrap_or_default()));
            first += count as u32;
        }
        let groups = self.groups.len();
        self.groups.par_extend(desks.into_par_iter().map(|(runs, first, receivers)| {
            let members = runs.iter().flat_map(|r| r.first..r.first + r.count);
            for ((receiver, at), i) in receivers.iter_mut().zip(first..).zip(members) {
                let position = self.points.position[i as usize] + Vec3::ZERO;
                let [x, y, z] = position.to_array().map(f32::to_bits);
                let place = &places[i as usize];
                let word = place.load(Relaxed);
                place.store(at | word & ACROSS, Relaxed);
                *receiver = [x, y, z, word];
            }
            group(self.planes, first, receivers)
        }));
        (self.count, self.places) = (first, places);
        (all, groups..self.groups.len())
    }

    /// Points of a range that are the CPU's from the beginning.
    pub(super) fn others(&self, range: Range<usize>) -> Vec<u32> {
        let is_other = |&i: &usize| self.places[i].load(Relaxed) == OTHER;
        range.into_par_iter().filter(is_other).map(|i| i as u32).collect()
    }

    /// A point's word.
    fn word(&self, index: usize) -> u32 {
        let position = self.points.position[index];
        if !position.is_finite() {
            return OTHER;
        }
        let normal = self.points.normal[index].as_dvec3();
        let Some(slot) = self.surfaces.slot(self.points.triangle[index]) else {
            return if normal == DVec3::ZERO { IN_AIR } else { OTHER };
        };
        let Some(own) = self.planes.normal(slot as usize) else { return OTHER };
        let back = own.dot(normal) < 0.0;
        let side = if back { slot | BACK } else { slot };
        let word = match self.elevations[slot as usize][usize::from(back)] {
            Elevation::Above => side,
            Elevation::Across => side | ACROSS,
            Elevation::Below => return BELOW,
        };
        if self.edge_on(position) { OTHER } else { word }
    }

    /// Whether a flat light is seen so flat that f32 does not do: the CPU may begin with these before the GPU is done,
    /// which has its own, narrower limit (`thin` in sight.wgsl).
    fn edge_on(&self, position: Vec3) -> bool {
        match *self.light {
            AreaLight::Rect { centre, half_u, half_v } => {
                let axis = centre - position;
                let volume = half_u.cross(half_v).dot(axis).abs();
                volume <= EDGE_ON * half_u.length() * half_v.length() * axis.length()
            }
            AreaLight::Disk { centre, normal, .. } => {
                let axis = centre - position;
                normal.dot(axis).abs() <= EDGE_ON * axis.length()
            }
            AreaLight::Sphere { .. } | AreaLight::Sun { .. } => false,
        }
    }
}

/// Of every slot, seen from its front and from its back: the light's height over a plane is the same
/// from all of the plane.
fn elevations(surfaces: &Surfaces, planes: &Planes, light: &AreaLight) -> Vec<[Elevation; 2]> {
    let aim = Aim::new(light, &Receiver::in_air(DVec3::ZERO));
    let of = |slot: usize| {
        let Some(normal) = planes.normal(slot) else { return [Elevation::Below; 2] };
        let position = surfaces.corners[slot][0].as_dvec3();
        match (*light, aim) {
            (AreaLight::Sphere { centre, radius_world }, _) => {
                let (height, radius) = (normal.dot(centre.as_dvec3() - position), f64::from(radius_world));
                [height, -height].map(|h| match (h > radius, h > -radius) {
                    (true, _) => Elevation::Above,
                    (false, true) => Elevation::Across,
                    (false, false) => Elevation::Below,
                })
            }
            (AreaLight::Sun { .. }, Some(aim)) => [normal, -normal].map(|n| aim.elevation(n)),
            // A flat light's axis begins where it is seen from.
            (_, Some(aim)) => {
                let aim = Aim { axis: aim.axis - position, ..aim };
                [normal, -normal].map(|n| aim.elevation(n))
            }
            (_, None) => [Elevation::Across; 2],
        }
    };
    (0..surfaces.corners.len()).into_par_iter().with_min_len(1024).map(of).collect()
}

fn group(planes: &Planes, first: u32, receivers: &[[u32; 4]]) -> Group {
    let mut low = Vec3::INFINITY;
    let mut high = Vec3::NEG_INFINITY;
    let plane = |word: u32| planes.get((word & IN_AIR) as usize).unwrap_or_default();
    let facing = |word: u32| if word & BACK == 0 { plane(word).0 } else { -plane(word).0 };
    let mut last = receivers[0][3];
    let mut normal = facing(last);
    for receiver in receivers {
        let [x, y, z, _] = receiver.map(f32::from_bits);
        let place = DVec3::new(x.into(), y.into(), z.into());
        // A receiver stands in its triangle's plane, wherever its point is.
        let (n, offset) = plane(receiver[3]);
        let place = (place - (n.dot(place) - offset) * n).as_vec3();
        (low, high) = (low.min(place), high.max(place));
        if receiver[3] != last {
            last = receiver[3];
            if facing(last) != normal {
                normal = DVec3::ZERO;
            }
        }
    }
    Group {
        low: low.to_array(),
        first,
        high: high.to_array(),
        count: receivers.len() as u32,
        normal: normal.as_vec3().to_array(),
        unused: 0,
    }
}

/// Points that follow each other and lie near each other, mostly neighbours in a row of a picture: an
/// eighth of the points to sort.
#[derive(Clone, Copy)]
struct Run {
    /// Which way it faces, then where the first lies on the Morton curve through the scene.
    key: u64,
    first: u32,
    count: u32,
}

/// Runs of the GPU's points among some that begin at an index.
fn runs(points: &Points, words: &mut [AtomicU32], (start, extent): (usize, f32)) -> Vec<Run> {
    // Half of the keys' range, for either sign.
    let scale = ((1 << (KEY_BITS - 1)) - 1) as f32 / extent.max(f32::MIN_POSITIVE);
    let key = |place: Vec3| {
        // Casts cut what is outside of the scene.
        let [x, y, z] =
            ((place + extent) * scale).to_array().map(|c| spread((c as u64).min((1 << KEY_BITS) - 1)));
        x | y << 1 | z << 2
    };
    // Receivers that face different ways see different things; those in mid-air, others again.
    let kind = |i: usize| {
        if points.normal[i] == Vec3::ZERO {
            return 6;
        }
        let normal = points.normal[i].abs();
        let axis = normal.max_position();
        2 * axis as u64 + u64::from(points.normal[i][axis] < 0.0)
    };
    let near = extent * NEAR;
    let mut runs: Vec<Run> = Vec::with_capacity(words.len() / 4);
    let mut open: Option<(Vec3, u64)> = None;
    for (word, i) in words.iter_mut().zip(start..) {
        if *word.get_mut() >= OTHER {
            open = None;
            continue;
        }
        let (place, kind) = (points.position[i], kind(i));
        match (open, runs.last_mut()) {
            (Some((first, same)), Some(run))
                if (run.count as usize) < RUN
                    && same == kind
                    && (place - first).abs().max_element() < near =>
            {
                run.count += 1;
            }
            _ => {
                runs.push(Run { key: key(place) | kind << (3 * KEY_BITS), first: i as u32, count: 1 });
                open = Some((place, kind));
            }
        }
    }
    runs
}

fn count(runs: &[Run]) -> usize {
    runs.iter().map(|r| r.count as usize).sum()
}

/// Cuts sorted runs at the highest bit that differs, as a linear tree is built (Lauterbach et al.
/// 2009), until groups are small enough.
fn split(runs: &[Run]) -> Vec<Range<usize>> {
    fn cut(runs: &[Run], range: Range<usize>) -> Vec<Range<usize>> {
        if range.is_empty() {
            return Vec::new();
        }
        let (first, last) = (runs[range.start].key, runs[range.end - 1].key);
        // Three bits a halving of a cell, of which the largest is twice the extent.
        let wide = (first ^ last) >> (3 * (KEY_BITS - 1 - WIDEST.ilog2())) != 0;
        let most = if wide { SPREAD } else { TOGETHER };
        if range.len() == 1 || range.len() <= most && count(&runs[range.clone()]) <= most {
            return vec![range];
        }
        let middle = if first == last {
            range.start + range.len() / 2
        } else {
            let bit = 63 - (first ^ last).leading_zeros();
            range.start + runs[range.clone()].partition_point(|r| r.key >> bit & 1 == 0)
        };
        let (before, after) = (range.start..middle, middle..range.end);
        let (mut one, other) = match range.len() > 1024 {
            true => rayon::join(|| cut(runs, before), || cut(runs, after)),
            false => (cut(runs, before), cut(runs, after)),
        };
        one.extend(other);
        one
    }
    cut(runs, 0..runs.len())
}
