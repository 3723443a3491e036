//! Receivers near each other share one walk of the tree.

use super::Rulings;
use super::blocks::{Blocks, Survey};
use super::frame::Frame;
use super::lines::{Lines, REPLICATES};
use super::facing::Standpoint;
use super::patches::Patches;
use super::shade::Shade;
use super::volume::Volume;
use super::winding::Winding;
use crate::Points;
use crate::aim::Aim;
use crate::receiver::Receiver;
use crate::samples::LightSamples;
use crate::truth::{Method, Scratch, Task};
use glam::{DVec3, Vec3};
use umbrage_scene::AreaLight;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::marker::PhantomData;
use std::ops::Range;

/// Receivers that share a list of candidates, at most.
const TOGETHER: usize = 64;

/// A list is made shorter for each half of the receivers while they are more than this, and it has more blocks of
/// eight triangles than that.
const FEW: usize = 8;
const SIMPLE: usize = 6;

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
    open: Vec<u32>,
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

/// Something that is found at each receiver.
pub(super) trait Find {
    type Found: Copy + Send;

    /// What is found where all of the light is hidden, if that can be told without its samples.
    const HIDDEN: Option<fn(&Task, &Receiver, &Desk) -> Self::Found> = None;

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
    let found: Vec<Vec<F::Found>> = groups
        .into_par_iter()
        .map_init(|| Desk::new(task.light), |desk, range| {
            let group =
                Group::<F> { task, rulings: &rulings, points, order: &order[range], desk, find: PhantomData };
            Arch::new().dispatch(group)
        })
        .collect();
    let mut each = vec![none; points.len()];
    for (&index, one) in order.iter().zip(found.into_iter().flatten()) {
        each[index as usize] = one;
    }
    each
}

/// Receivers near each other. Compiled for the widest registers that there are; the same bits with any.
struct Group<'a, F> {
    task: &'a Task<'a>,
    rulings: &'a Rulings,
    points: &'a Points,
    order: &'a [u32],
    desk: &'a mut Desk,
    find: PhantomData<F>,
}

impl<F: Find> WithSimd for Group<'_, F> {
    type Output = Vec<F::Found>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<F::Found> {
        let Self { task, rulings, points, order, desk, .. } = self;
        let surfaces = &task.tracer.surfaces;
        let mut receivers: Vec<Placed> = Vec::with_capacity(order.len());
        for (at, &index) in order.iter().enumerate() {
            let last = receivers.last().map(|placed| &placed.receiver);
            let receiver = Receiver::beside(last, surfaces, points, index as usize);
            receivers.push(Placed { receiver, index, at: at as u32 });
        }
        let mut found: Vec<Option<F::Found>> = vec![None; order.len()];
        let mut last = 0;
        if task.settings.method == Method::ScanlineRays {
            for placed in &receivers {
                let point = (&placed.receiver, points, placed.index as usize);
                found[placed.at as usize] = Some(F::find(task, rulings, point, desk, &mut last));
            }
            return found.into_iter().flatten().collect();
        }
        // Depth first: the list of a part is on the desk until both of its halves are done.
        let mut parts = vec![(0..receivers.len(), 0)];
        while let Some((range, depth)) = parts.pop() {
            let part = &mut receivers[range.clone()];
            let standpoint = Standpoint::new(task.light, part);
            if let (Some(standpoint), Some(hidden)) = (&standpoint, F::HIDDEN)
                && let Some(aim) = standpoint.aim(task.light)
                && desk.shade.hides(surfaces, standpoint, &aim)
            {
                for placed in &receivers[range] {
                    found[placed.at as usize] = Some(hidden(task, &placed.receiver, desk));
                }
                continue;
            }
            let volume = Volume::new(task.light, part, f64::from(surfaces.extent));
            if desk.lists.len() <= depth {
                desk.lists.resize_with(depth + 1, Blocks::default);
            }
            if depth == 0 {
                volume.gather(surfaces, (&mut desk.open, &mut desk.lists[0], &mut desk.cards));
            } else if let [.., from, into] = &mut desk.lists[..=depth] {
                volume.filter(from, into);
            }
            let candidates = desk.lists[depth].blocks.len();
            if part.len() > FEW && candidates > SIMPLE {
                let middle = range.start + halve(part);
                if range.contains(&middle) && middle > range.start {
                    parts.push((middle..range.end, depth + 1));
                    parts.push((range.start..middle, depth + 1));
                    continue;
                }
            }
            desk.patches.sort(surfaces, standpoint.as_ref(), (&desk.lists[depth], &mut desk.blocks));
            desk.blocks.close();
            last = 0;
            for placed in &receivers[range] {
                let point = (&placed.receiver, points, placed.index as usize);
                found[placed.at as usize] = Some(F::find(task, rulings, point, desk, &mut last));
            }
        }
        found.into_iter().flatten().collect()
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
    let scale = 2_097_151.0 / (high - low).max_element().max(f32::MIN_POSITIVE);
    let mut keyed: Vec<(u64, u32)> = (0..points.len())
        .into_par_iter()
        .map(|i| {
            let [x, y, z] = ((points.position[i] - low) * scale).to_array().map(|c| spread(c as u64));
            (x | y << 1 | z << 2, i as u32)
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
