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
/// How near they lie, in parts of the scene's largest coordinate.
const NEAR: f32 = 1.0 / 64.0;
/// Points that a thread takes at a time.
const CHUNK: usize = 4096;

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
        let mut words = vec![0; points.len()];
        let mut runs: Vec<Run> = words
            .par_chunks_mut(CHUNK)
            .enumerate()
            .flat_map_iter(|(chunk, words)| {
                let first = chunk * CHUNK;
                for (word, i) in words.iter_mut().zip(first..) {
                    *word = self::word((surfaces, planes), &elevations, points, i);
                }
                runs(points, words, (first, surfaces.extent))
            })
            .collect();
        runs.par_sort_unstable_by_key(|run| (run.key, run.first));
        let companies = split(&runs);
        let mut order = vec![0; count(&runs)];
        let mut receivers = vec![[0; 4]; order.len()];
        let (mut order_left, mut receivers_left, mut first) = (&mut order[..], &mut receivers[..], 0);
        let mut desks = Vec::with_capacity(companies.len());
        for company in companies {
            let runs = &runs[company];
            let count = count(runs);
            desks.push((
                runs,
                first,
                order_left.split_off_mut(..count).unwrap_or_default(),
                receivers_left.split_off_mut(..count).unwrap_or_default(),
            ));
            first += count as u32;
        }
        let groups = desks
            .into_par_iter()
            .map(|(runs, first, order, receivers)| {
                let members = runs.iter().flat_map(|r| r.first..r.first + r.count);
                for ((into, receiver), i) in order.iter_mut().zip(receivers.iter_mut()).zip(members) {
                    *into = i;
                    let place = points.position[i as usize] + Vec3::ZERO;
                    let [x, y, z] = place.to_array().map(f32::to_bits);
                    *receiver = [x, y, z, words[i as usize]];
                }
                group(planes, points, first, receivers, order)
            })
            .collect();
        Self { words, order, receivers, groups }
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

fn group(planes: &Planes, points: &Points, first: u32, receivers: &[[u32; 4]], order: &[u32]) -> Group {
    let mut low = Vec3::INFINITY;
    let mut high = Vec3::NEG_INFINITY;
    let plane = |word: u32| {
        let normal = planes.normal((word & IN_AIR) as usize).unwrap_or_default();
        if word & BACK == 0 { normal } else { -normal }
    };
    let mut last = receivers[0][3];
    let mut normal = plane(last);
    for (receiver, &i) in receivers.iter().zip(order) {
        let place = points.position[i as usize];
        (low, high) = (low.min(place), high.max(place));
        if receiver[3] != last {
            last = receiver[3];
            if plane(last) != normal {
                normal = DVec3::ZERO;
            }
        }
    }
    Group {
        low: low.to_array(),
        first,
        high: high.to_array(),
        count: order.len() as u32,
        normal: normal.as_vec3().to_array(),
        unused: 0,
    }
}

/// Points that follow each other and lie near each other, mostly neighbours in a row of a picture: an
/// eighth of the points to sort.
#[derive(Clone, Copy)]
struct Run {
    /// Where the first lies, on the Morton curve through the scene.
    key: u64,
    first: u32,
    count: u32,
}

/// Runs of the GPU's points among some that begin at an index.
fn runs(points: &Points, words: &[u32], (start, extent): (usize, f32)) -> Vec<Run> {
    let scale = 1_048_575.0 / extent.max(f32::MIN_POSITIVE);
    let key = |place: Vec3| {
        // Casts cut what is outside of the scene.
        let [x, y, z] = ((place + extent) * scale).to_array().map(|c| spread((c as u64).min(0x1f_ffff)));
        x | y << 1 | z << 2
    };
    let near = extent * NEAR;
    let mut runs: Vec<Run> = Vec::with_capacity(words.len() / 4);
    let mut open: Option<Vec3> = None;
    for (&word, i) in words.iter().zip(start..) {
        if word >= OTHER {
            open = None;
            continue;
        }
        let place = points.position[i];
        match (open, runs.last_mut()) {
            (Some(first), Some(run))
                if (run.count as usize) < RUN && (place - first).abs().max_element() < near =>
            {
                run.count += 1;
            }
            _ => {
                runs.push(Run { key: key(place), first: i as u32, count: 1 });
                open = Some(place);
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
