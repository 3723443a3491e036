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
use umbrage_scene::AreaLight;

/// Receivers that share a list of candidates, at most: a workgroup's threads.
const TOGETHER: usize = 64;
/// Points that stay together when the others are sorted.
const RUN: usize = 8;
/// Bits of a place's code that all points of a run share: the 128th part of the scene on each axis.
const NEAR: u32 = 42;

/// Words of a point: the slot of its triangle, what it sees, or why it is not the GPU's.
pub(super) const IN_AIR: u32 = 0x0fff_ffff;
pub(super) const BACK: u32 = 0x1000_0000;
pub(super) const ACROSS: u32 = 0x2000_0000;
/// The light is below its horizon: V is 0.
pub(super) const BELOW: u32 = 0xffff_ffff;
/// A horizon without a triangle, or a place that is no number: for the CPU.
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

/// Everything that one upload holds.
pub(super) struct Prepared {
    /// A word for each point.
    pub(super) words: Vec<u32>,
    /// Indices of the GPU's points, neighbours together.
    pub(super) order: Vec<u32>,
    /// Place and word of each, in that order.
    pub(super) receivers: Vec<[u32; 4]>,
    pub(super) groups: Vec<Group>,
}

impl Prepared {
    pub(super) fn new((surfaces, planes): (&Surfaces, &Planes), points: &Points, light: &AreaLight) -> Self {
        let elevations = elevations(surfaces, planes, light);
        let word = |i: usize| word((surfaces, planes), &elevations, points, i);
        let words: Vec<u32> = (0..points.len()).into_par_iter().map(word).collect();
        let (order, counts) = neighbours(points, &words);
        let receivers = order
            .par_iter()
            .map(|&i| {
                let [x, y, z] = (points.position[i as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
                [x, y, z, words[i as usize]]
            })
            .collect();
        let mut first = 0;
        let ranges: Vec<Range<usize>> = counts
            .into_iter()
            .map(|count| {
                first += count;
                first - count..first
            })
            .collect();
        let group = |range: Range<usize>| group(planes, points, &words, (&order, range));
        let groups = ranges.into_par_iter().map(group).collect();
        Self { words, order, receivers, groups }
    }
}

/// Of every slot, seen from its front and from its back: the light's height over a plane is the same
/// from all of the plane.
fn elevations(surfaces: &Surfaces, planes: &Planes, light: &AreaLight) -> Vec<[Elevation; 2]> {
    let of = |slot: usize| {
        let Some(normal) = planes.normal(slot) else { return [Elevation::Below; 2] };
        let position = surfaces.corners[slot][0].as_dvec3();
        if let AreaLight::Sphere { centre, radius_world } = *light {
            let (height, radius) = (normal.dot(centre.as_dvec3() - position), f64::from(radius_world));
            return [height, -height].map(|h| match (h > radius, h > -radius) {
                (true, _) => Elevation::Above,
                (false, true) => Elevation::Across,
                (false, false) => Elevation::Below,
            });
        }
        match Aim::new(light, &Receiver { position, normal, slot: None }) {
            Some(aim) => [normal, -normal].map(|n| aim.elevation(n)),
            None => [Elevation::Across; 2],
        }
    };
    (0..surfaces.corners.len()).into_par_iter().with_min_len(1024).map(of).collect()
}

fn word(
    (surfaces, planes): (&Surfaces, &Planes),
    elevations: &[[Elevation; 2]],
    points: &Points,
    index: usize,
) -> u32 {
    if !points.position[index].is_finite() {
        return OTHER;
    }
    let normal = points.normal[index].as_dvec3();
    let Some(slot) = surfaces.slot(points.triangle[index]) else {
        return if normal == DVec3::ZERO { IN_AIR } else { OTHER };
    };
    let Some(own) = planes.normal(slot as usize) else { return OTHER };
    let back = own.dot(normal) < 0.0;
    let side = if back { slot | BACK } else { slot };
    match elevations[slot as usize][usize::from(back)] {
        Elevation::Above => side,
        Elevation::Across => side | ACROSS,
        Elevation::Below => BELOW,
    }
}

fn group(planes: &Planes, points: &Points, words: &[u32], (order, range): (&[u32], Range<usize>)) -> Group {
    let mut low = Vec3::INFINITY;
    let mut high = Vec3::NEG_INFINITY;
    let plane = |i: u32| {
        let word = words[i as usize];
        let normal = planes.normal((word & IN_AIR) as usize).unwrap_or_default();
        if word & BACK == 0 { normal } else { -normal }
    };
    let mut normal = plane(order[range.start]);
    let mut last = words[order[range.start] as usize];
    for &i in &order[range.clone()] {
        low = low.min(points.position[i as usize]);
        high = high.max(points.position[i as usize]);
        let word = words[i as usize];
        if word != last {
            last = word;
            if plane(i) != normal {
                normal = DVec3::ZERO;
            }
        }
    }
    Group {
        low: low.to_array(),
        first: range.start as u32,
        high: high.to_array(),
        count: range.len() as u32,
        normal: normal.as_vec3().to_array(),
        unused: 0,
    }
}

/// Points that follow each other and lie near each other, mostly neighbours in a row of a picture: an
/// eighth of the points to sort.
#[derive(Clone, Copy)]
struct Run {
    key: u64,
    /// Among the GPU's points.
    first: u32,
    count: u32,
}

/// The GPU's points in an order in which neighbours stand together, and the sizes of groups.
fn neighbours(points: &Points, words: &[u32]) -> (Vec<u32>, Vec<usize>) {
    let live: Vec<u32> =
        (0..points.len() as u32).into_par_iter().filter(|&i| words[i as usize] < OTHER).collect();
    let (low, high) = live
        .par_iter()
        .map(|&i| (points.position[i as usize], points.position[i as usize]))
        .reduce(|| (Vec3::INFINITY, Vec3::NEG_INFINITY), |a, b| (a.0.min(b.0), a.1.max(b.1)));
    let scale = 2_097_151.0 / (high - low).max_element().max(f32::MIN_POSITIVE);
    let key = |i: u32| {
        let place = (points.position[i as usize] - low) * scale;
        let [x, y, z] = place.to_array().map(|c| spread(c as u64));
        x | y << 1 | z << 2
    };
    let mut runs: Vec<Run> = live
        .par_chunks(4096)
        .enumerate()
        .flat_map_iter(|(chunk, live)| runs(live, (chunk * 4096) as u32, key))
        .collect();
    runs.par_sort_unstable_by_key(|run| (run.key, run.first));
    let groups = split(&runs);
    let members = |group: &Range<usize>| {
        runs[group.clone()].iter().flat_map(|r| &live[r.first as usize..(r.first + r.count) as usize])
    };
    let order = groups.par_iter().flat_map_iter(|group| members(group).copied()).collect();
    let sizes = groups.iter().map(|group| count(&runs[group.clone()])).collect();
    (order, sizes)
}

fn runs(live: &[u32], offset: u32, key: impl Fn(u32) -> u64) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::with_capacity(live.len() / 4);
    for (at, &i) in live.iter().enumerate() {
        let key = key(i);
        match runs.last_mut() {
            Some(run) if (run.count as usize) < RUN && run.key >> NEAR == key >> NEAR => run.count += 1,
            _ => runs.push(Run { key, first: offset + at as u32, count: 1 }),
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
        if range.len() <= TOGETHER && count(&runs[range.clone()]) <= TOGETHER {
            return if range.is_empty() { Vec::new() } else { vec![range] };
        }
        let (first, last) = (runs[range.start].key, runs[range.end - 1].key);
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
