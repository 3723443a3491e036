//! Receivers near each other share one walk of the tree.

use super::Rulings;
use super::blocks::{Blocks, Survey};
use super::lines::{Lines, REPLICATES};
use super::patches::Patches;
use super::volume;
use super::winding::Winding;
use crate::Points;
use crate::receiver::Receiver;
use crate::samples::LightSamples;
use crate::truth::{Method, Scratch, Task};
use glam::Vec3;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::marker::PhantomData;
use std::ops::Range;

/// Receivers that share a list of candidates, at most.
const TOGETHER: usize = 64;

/// What a thread keeps from group to group.
#[derive(Default)]
pub(super) struct Desk {
    pub(super) scratch: Scratch,
    /// Triangles that are sure to be between, as edges.
    pub(super) patches: Patches,
    pub(super) winding: Winding,
    /// The others.
    pub(super) blocks: Blocks,
    all: Blocks,
    /// Cut-out triangles.
    pub(super) cards: Blocks,
    /// What was hidden before one of them, per row.
    pub(super) before: Vec<[u32; REPLICATES]>,
    pub(super) surveys: Vec<(usize, Survey)>,
    open: Vec<u32>,
    pub(super) lines: Lines,
    pub(super) samples: LightSamples,
}

/// Something that is found at each receiver.
pub(super) trait Find {
    type Found: Copy + Send;

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
        .map_init(Desk::default, |desk, range| {
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
        let receivers: Vec<Receiver> =
            order.iter().map(|&i| Receiver::new(surfaces, points, i as usize)).collect();
        if task.settings.method != Method::ScanlineRays {
            volume::gather(
                surfaces,
                task.light,
                &receivers,
                (&mut desk.open, &mut desk.all, &mut desk.cards),
            );
            desk.patches.sort(surfaces, task.light, &receivers, (&desk.all, &mut desk.blocks));
            desk.blocks.close();
        }
        let mut last = 0;
        let mut found = Vec::with_capacity(order.len());
        for (receiver, &index) in receivers.iter().zip(order) {
            found.push(F::find(task, rulings, (receiver, points, index as usize), desk, &mut last));
        }
        found
    }
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
