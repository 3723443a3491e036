//! Receivers near each other share one walk of the tree.

use super::Rulings;
use super::blocks::{Blocks, Survey};
use super::eight::LANES;
use super::facing::Standpoint;
use super::frame::Frame;
use super::lines::{Lines, REPLICATES};
use super::patches::Patches;
use super::shade::Shade;
use super::volume::Volume;
use super::winding::Winding;
use crate::Points;
use crate::aim::{Aim, Elevation};
use crate::receiver::Receiver;
use crate::samples::LightSamples;
use crate::surfaces::Surfaces;
use crate::truth::{Method, Scratch, Task};
use glam::{DVec3, Vec3};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};
use umbrage_scene::AreaLight;

/// Receivers that share a list of candidates, at most.
const TOGETHER: usize = 64;

/// A list is made shorter for each half of the receivers while they are more than this, and it has more blocks of
/// eight triangles than that.
const FEW: usize = 16;
const SIMPLE: usize = 32;

/// Beyond that many receivers it is made shorter again even if the last time did not help.
const MANY: usize = 32;

/// Parts of fewer receivers are not asked whether one patch hides the light from all of them.
const WORTH_ASKING: usize = 8;

/// Rays are faster where a receiver would have to look at more edges than this, or at rows of edges, for each of its
/// samples, or at triangles one by one, each of which takes about as long as so many edges; or where more triangles than `LISTED` would have to be
/// listed for each sample of a group (docs/performance.md).
pub(super) const PER_RAY: usize = 96;
const TRIANGLE: usize = 8;
const LISTED: usize = 4;

/// Normals that differ by more in a coordinate are told apart before places.
const TURNED: f64 = 0.5;

/// What a thread keeps from group to group.
#[derive(Default)]
pub(super) struct Desk {
    pub(super) scratch: Scratch,
    /// Triangles that are sure to be between, as edges.
    pub(super) shade: Shade,
    pub(super) patches: Patches,
    pub(super) winding: Winding,
    /// The others.
    pub(super) blocks: Blocks,
    /// Candidates of a group, of a part of it, of a part of that, ...
    lists: Vec<Blocks>,
    /// Cut-out triangles.
    pub(super) cards: Blocks,
    /// What was hidden before one of them, per row.
    pub(super) before: Vec<[u32; REPLICATES]>,
    pub(super) surveys: Vec<(usize, Survey)>,
    /// Triangles across a sphere's depths.
    pub(super) straddling: Vec<u32>,
    pub(super) open: Vec<u32>,
    /// Whether so much is before a part of a group that rays are faster.
    pub(super) crowded: bool,
    /// Whether rays have found what the receiver that looked last sees, cut-out triangles and all.
    pub(super) asked: bool,
    /// A sun is the same from everywhere.
    sun: Option<(Aim, Option<Frame>)>,
    pub(super) lines: Lines,
    pub(super) samples: LightSamples,
}

impl Desk {
    #[inline(always)]
    pub(super) fn aim(&self, light: &AreaLight, receiver: &Receiver) -> Option<Aim> {
        match &self.sun {
            Some((aim, _)) => Some(*aim),
            None => Aim::new(light, receiver),
        }
    }

    #[inline(always)]
    pub(super) fn frame(&self, receiver: &Receiver, aim: &Aim) -> Option<Frame> {
        match &self.sun {
            Some((_, frame)) => {
                let mut frame = (*frame)?;
                frame.stand(receiver);
                Some(frame)
            }
            None => Frame::new(receiver, aim),
        }
    }

    fn new(light: &AreaLight) -> Self {
        let sun = matches!(light, AreaLight::Sun { .. }).then(|| {
            let anywhere = Receiver::in_air(DVec3::ZERO);
            Aim::new(light, &anywhere).map(|aim| (aim, Frame::new(&anywhere, &aim)))
        });
        Self { sun: sun.flatten(), ..Self::default() }
    }
}

/// What is found at a receiver from which all of the light is hidden.
pub(super) type Hidden<T> = fn(&Task, &Receiver, &Desk) -> T;

/// Something that is found at each receiver.
pub(super) trait Find {
    type Found: Copy + Send + Sync;

    /// What is found where the whole light is below the horizon.
    const BELOW: Self::Found;

    /// What is found where all of the light is hidden, if that can be told without its samples.
    const HIDDEN: Option<Hidden<Self::Found>> = None;

    /// At one receiver, of whose group the candidates are on the desk. `last` is the block that hid the light
    /// from the neighbour.
    fn find(
        task: &Task,
        rulings: &Rulings,
        point: (&Receiver, &Points, usize),
        desk: &mut Desk,
        last: &mut usize,
    ) -> Self::Found;
}

/// At all points, in their order.
pub(super) fn find<F: Find>(task: &Task, points: &Points, none: F::Found) -> Vec<F::Found> {
    let rulings = Rulings::new(task.settings, task.light);
    let (order, groups) = neighbours(points);
    let mut found = vec![none; points.len()];
    // Groups stand in the order's order.
    let mut rest = found.as_mut_slice();
    let mut parts = Vec::with_capacity(groups.len());
    for range in groups {
        let (part, others) = rest.split_at_mut(range.len());
        parts.push((part, range));
        rest = others;
    }
    parts.into_par_iter().for_each_init(
        || Desk::new(task.light),
        |desk, (found, range)| {
            let order = &order[range];
            Arch::new().dispatch(Group::<F> { task, rulings: &rulings, points, order, desk, found });
        },
    );
    let place: Vec<AtomicU32> = (0..points.len()).into_par_iter().map(|_| AtomicU32::new(0)).collect();
    order.par_iter().enumerate().for_each(|(at, &index)| place[index as usize].store(at as u32, Relaxed));
    place.into_par_iter().map(|at| found[at.into_inner() as usize]).collect()
}

/// Receivers near each other. Compiled for the widest registers that there are; the same bits with any.
struct Group<'a, F: Find> {
    task: &'a Task<'a>,
    rulings: &'a Rulings,
    points: &'a Points,
    order: &'a [u32],
    desk: &'a mut Desk,
    /// Of each point in the order; filled with what is found where there is no light to see.
    found: &'a mut [F::Found],
}

impl<F: Find> WithSimd for Group<'_, F> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { task, rulings, points, order, desk, found } = self;
        let surfaces = &task.tracer.surfaces;
        let mut receivers: Vec<Placed> = Vec::with_capacity(order.len());
        let mut last = None;
        for (at, &index) in order.iter().enumerate() {
            let receiver = Receiver::beside(last.as_ref(), surfaces, points, index as usize);
            last = Some(receiver);
            let Some(aim) = desk.aim(task.light, &receiver) else { continue };
            if aim.elevation(receiver.normal) == Elevation::Below {
                found[at] = F::BELOW;
            } else {
                receivers.push(Placed { receiver, index, at: at as u32 });
            }
        }
        if receivers.is_empty() {
            return;
        }
        // A light that is a point is asked by a ray for each receiver.
        let point = desk.aim(task.light, &receivers[0].receiver).is_some_and(|aim| aim.is_point());
        let samples = rulings.samples();
        let rays = point || task.settings.method == Method::ScanlineRays;
        // Depth first: the list of a part is on the desk until both of its halves are done.
        let mut parts = vec![(0..receivers.len(), 0)];
        while let Some((range, depth)) = parts.pop() {
            let part = &mut receivers[range.clone()];
            let standpoint = if rays { None } else { Standpoint::new(task.light, part) };
            if let (Some(standpoint), Some(hidden)) = (&standpoint, F::HIDDEN)
                && let Some(aim) = standpoint.aim(task.light)
                && (depth == 0 || range.len() >= WORTH_ASKING)
                && desk.shade.hides(surfaces, standpoint, &aim)
            {
                for placed in &receivers[range] {
                    found[placed.at as usize] = hidden(task, &placed.receiver, desk);
                }
                continue;
            }
            if !rays {
                let volume = Volume::new(task.light, part, f64::from(surfaces.extent));
                if desk.lists.len() <= depth {
                    desk.lists.resize_with(depth + 1, Blocks::default);
                }
                let most = range.len() * samples * LISTED;
                let all = Arch::new().dispatch(List { surfaces, volume: &volume, desk, depth, most });
                let candidates = desk.lists[depth].blocks.len();
                let shrinks = depth == 0
                    || 4 * candidates < 3 * desk.lists[depth - 1].blocks.len()
                    || part.len() > MANY;
                if all && part.len() > FEW && candidates > SIMPLE && shrinks {
                    let middle = range.start + halve(part);
                    if range.contains(&middle) && middle > range.start {
                        parts.push((middle..range.end, depth + 1));
                        parts.push((range.start..middle, depth + 1));
                        continue;
                    }
                }
                if all {
                    Arch::new().dispatch(Sort { surfaces, standpoint: standpoint.as_ref(), desk, depth });
                }
                let alone = desk.blocks.blocks.len() + desk.cards.blocks.len();
                let tests = desk.patches.len() + TRIANGLE * LANES * alone;
                desk.crowded = !all || tests > samples * PER_RAY;
            }
            let mut last = 0;
            for placed in &receivers[range] {
                let point = (&placed.receiver, points, placed.index as usize);
                found[placed.at as usize] = F::find(task, rulings, point, desk, &mut last);
            }
        }
    }
}

/// Lists what is before the receivers of a part. Compiled for wide registers by itself, as the next.
struct List<'a> {
    surfaces: &'a Surfaces,
    volume: &'a Volume,
    desk: &'a mut Desk,
    depth: usize,
    most: usize,
}

impl WithSimd for List<'_> {
    /// Whether all is listed: a list may be too long to be worth it.
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        let Self { surfaces, volume, desk, depth, most } = self;
        if depth == 0 {
            return volume.gather(surfaces, (&mut desk.open, &mut desk.lists[0], &mut desk.cards), most);
        }
        if let [.., from, into] = &mut desk.lists[..=depth] {
            volume.filter(from, into);
        }
        true
    }
}

/// Makes patches of a list.
struct Sort<'a> {
    surfaces: &'a Surfaces,
    standpoint: Option<&'a Standpoint>,
    desk: &'a mut Desk,
    depth: usize,
}

impl WithSimd for Sort<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { surfaces, standpoint, desk, depth } = self;
        desk.patches.sort(surfaces, standpoint, (&desk.lists[depth], &mut desk.blocks));
        desk.blocks.close();
    }
}

/// A receiver of a group, its point, and where it stands in the group's order.
#[derive(Clone, Copy)]
pub(super) struct Placed {
    pub(super) receiver: Receiver,
    index: u32,
    at: u32,
}

/// Puts receivers of one kind before those of another: by their normals if those differ most, otherwise by their
/// places. Returns where the second kind starts.
fn halve(part: &mut [Placed]) -> usize {
    let spread = |pick: fn(&Receiver) -> DVec3| {
        let each = || part.iter().map(|placed| pick(&placed.receiver));
        let low = each().fold(DVec3::INFINITY, DVec3::min);
        (low, each().fold(DVec3::NEG_INFINITY, DVec3::max))
    };
    let normals = spread(|r| r.normal);
    let turned = (normals.1 - normals.0).max_element() > TURNED;
    let (pick, (low, high)): (fn(&Receiver) -> DVec3, _) =
        if turned { (|r| r.normal, normals) } else { (|r| r.position, spread(|r| r.position)) };
    let axis = (high - low).max_position();
    let middle = 0.5 * (low[axis] + high[axis]);
    part.sort_by_key(|placed| pick(&placed.receiver)[axis] > middle);
    part.partition_point(|placed| pick(&placed.receiver)[axis] <= middle)
}

/// The points in an order in which neighbours stand together, and that order cut into groups.
fn neighbours(points: &Points) -> (Vec<u32>, Vec<Range<usize>>) {
    let mut low = Vec3::INFINITY;
    let mut high = Vec3::NEG_INFINITY;
    for &p in &points.position {
        (low, high) = (low.min(p), high.max(p));
    }
    let scale = 1_048_575.0 / (high - low).max_element().max(f32::MIN_POSITIVE);
    let mut keyed: Vec<(u64, u32)> = (0..points.len())
        .into_par_iter()
        .map(|i| {
            let [x, y, z] = ((points.position[i] - low) * scale).to_array().map(|c| spread(c as u64));
            // Receivers that face different ways see different things.
            let normal = points.normal[i].abs();
            let axis = normal.max_position();
            let kind = 2 * axis as u64 + u64::from(points.normal[i][axis] < 0.0);
            (x | y << 1 | z << 2 | kind << 60, i as u32)
        })
        .collect();
    keyed.par_sort_unstable();
    let mut groups = Vec::new();
    let mut open = Vec::new();
    open.push(0..keyed.len());
    while let Some(range) = open.pop() {
        if range.len() <= TOGETHER {
            if !range.is_empty() {
                groups.push(range);
            }
            continue;
        }
        // At the highest bit that differs, as a linear tree is built (Lauterbach et al. 2009).
        let (first, last) = (keyed[range.start].0, keyed[range.end - 1].0);
        let middle = if first == last {
            range.start + range.len() / 2
        } else {
            let bit = 63 - (first ^ last).leading_zeros();
            range.start + keyed[range.clone()].partition_point(|k| k.0 >> bit & 1 == 0)
        };
        open.push(middle..range.end);
        open.push(range.start..middle);
    }
    (keyed.into_iter().map(|k| k.1).collect(), groups)
}

/// The lower 21 bits, two zeros between each.
pub(crate) fn spread(word: u64) -> u64 {
    let mut w = word & 0x1f_ffff;
    w = (w | w << 32) & 0x001f_0000_0000_ffff;
    w = (w | w << 16) & 0x001f_0000_ff00_00ff;
    w = (w | w << 8) & 0x100f_00f0_0f00_f00f;
    w = (w | w << 4) & 0x10c3_0c30_c30c_30c3;
    (w | w << 2) & 0x1249_2492_4924_9249
}
