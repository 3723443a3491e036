//! Way 2 on scanlines: each receiver rasterises what is between into a bit mask of the light
//! (GROUND_TRUTH, section 0).
//!
//! Samples stand on parallel lines across the light, so that a triangle covers one run of bits of
//! each line. Receivers that are near each other share one walk of the tree. A receiver's result is
//! a function of its place alone: a longer list of candidates covers the same bits.
#![expect(clippy::needless_range_loop, reason = "a lane is an index into several arrays at once")]

mod blocks;
mod eight;
mod frame;
mod lines;
mod outline;
mod volume;
mod weights;

use crate::aim::{Aim, Elevation};
use crate::irradiance::Emitter;
use crate::owen::mix;
use crate::rays;
use crate::receiver::Receiver;
use crate::samples::{LightSamples, seed};
use crate::truth::{MOST_ON_SCANLINES, Method, PointTruth, Scratch, Sight, Task};
use crate::{Points, TruthSettings};
use blocks::{Blocks, Survey};
use eight::LANES;
pub(crate) use frame::Frame;
use frame::Turn;
use glam::Vec3;
use lines::{Lines, REPLICATES};
pub(crate) use lines::{Ruling, STEP};
pub(crate) use outline::{BEYOND, MARGIN};
use outline::{Edge, Outline};
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;
use umbrage_scene::AreaLight;
pub(crate) use volume::{bounds, sides};

/// Receivers that share a list of candidates, at most.
const TOGETHER: usize = 64;

/// What a thread keeps from group to group.
#[derive(Default)]
struct Desk {
    scratch: Scratch,
    blocks: Blocks,
    surveys: Vec<(usize, Survey)>,
    open: Vec<u32>,
    lines: Lines,
    samples: LightSamples,
}

/// The truth at all points, in their order.
pub(crate) fn truth(task: &Task, points: &Points) -> Vec<PointTruth> {
    let found = each_group(task, points, |group| Arch::new().dispatch(Looking(group)));
    in_order(found, PointTruth::exact(1.0, false), points)
}

/// E, E0 and R at all points, in their order.
pub(crate) fn irradiance(task: &Task, points: &Points) -> Vec<[f32; 3]> {
    let found = each_group(task, points, |group| Arch::new().dispatch(Weighing(group)));
    in_order(found, [0.0; 3], points)
}

/// What a function finds at the receivers of each group, and which they are.
fn each_group<T: Send>(
    task: &Task,
    points: &Points,
    find: impl Fn(Group) -> Vec<T> + Sync,
) -> (Vec<u32>, Vec<Vec<T>>) {
    let rulings = Rulings::new(task.settings, task.light);
    let (order, groups) = neighbours(points);
    let found = groups
        .into_par_iter()
        .map_init(Desk::default, |desk, range| {
            find(Group { task, rulings: &rulings, points, order: &order[range], desk })
        })
        .collect();
    (order, found)
}

fn in_order<T: Copy>((order, found): (Vec<u32>, Vec<Vec<T>>), none: T, points: &Points) -> Vec<T> {
    let mut each = vec![none; points.len()];
    for (&index, one) in order.iter().zip(found.into_iter().flatten()) {
        each[index as usize] = one;
    }
    each
}

/// Samples that the mean is made of at each point (on a round light on average).
pub(crate) fn samples(settings: &TruthSettings, light: &AreaLight) -> u32 {
    Rulings::new(settings, light).mean.samples() as u32
}

pub(crate) struct Rulings {
    pub(crate) mean: Ruling,
    pub(crate) basis: Option<Ruling>,
}

impl Rulings {
    pub(crate) fn new(settings: &TruthSettings, light: &AreaLight) -> Self {
        let round = !matches!(light, AreaLight::Rect { .. });
        let most = 2 * MOST_ON_SCANLINES;
        let ruling = |samples: u32| Ruling::new(samples.min(most).div_ceil(REPLICATES as u32), round);
        let basis = (settings.basis_samples > 0).then(|| ruling(settings.basis_samples));
        Self { mean: ruling(settings.samples.saturating_mul(2)), basis }
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

/// Receivers near each other.
struct Group<'a> {
    task: &'a Task<'a>,
    rulings: &'a Rulings,
    points: &'a Points,
    order: &'a [u32],
    desk: &'a mut Desk,
}

/// Finds the truth. Compiled for the widest registers that there are; the same bits with any.
struct Looking<'a>(Group<'a>);

/// Finds the irradiance.
struct Weighing<'a>(Group<'a>);

impl WithSimd for Looking<'_> {
    type Output = Vec<PointTruth>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<PointTruth> {
        let Group { task, rulings, points, order, desk } = self.0;
        let receivers = receivers(task, points, order, desk);
        let mut last = 0;
        let mut found = Vec::with_capacity(order.len());
        for (receiver, &index) in receivers.iter().zip(order) {
            found.push(point(task, rulings, (receiver, points, index as usize), desk, &mut last));
        }
        found
    }
}

impl WithSimd for Weighing<'_> {
    type Output = Vec<[f32; 3]>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Vec<[f32; 3]> {
        let Group { task, rulings, points, order, desk } = self.0;
        let receivers = receivers(task, points, order, desk);
        let mut last = 0;
        let mut found = Vec::with_capacity(order.len());
        for (receiver, &index) in receivers.iter().zip(order) {
            found.push(weighed(task, rulings, (receiver, points, index as usize), desk, &mut last));
        }
        found
    }
}

/// The receivers of a group, with their candidates on the desk.
#[inline(always)]
fn receivers(task: &Task, points: &Points, order: &[u32], desk: &mut Desk) -> Vec<Receiver> {
    let surfaces = &task.tracer.surfaces;
    let receivers: Vec<Receiver> =
        order.iter().map(|&i| Receiver::new(surfaces, points, i as usize)).collect();
    if task.settings.method != Method::ScanlineRays {
        volume::gather(surfaces, task.light, &receivers, (&mut desk.open, &mut desk.blocks));
    }
    receivers
}

/// E, E0 and R of one point, from the samples that the mean of its truth is made of.
#[inline(always)]
fn weighed(
    task: &Task,
    rulings: &Rulings,
    (receiver, points, index): (&Receiver, &Points, usize),
    desk: &mut Desk,
    last: &mut usize,
) -> [f32; 3] {
    let Some(aim) = Aim::new(task.light, receiver) else { return [0.0; 3] };
    if aim.elevation(receiver.normal) == Elevation::Below {
        return [0.0; 3];
    }
    let Some(frame) = Frame::new(receiver, &aim) else {
        return task.irradiance(points, index, &mut desk.scratch);
    };
    let ruling = &rulings.mean;
    let seed = mix(seed(task.seed, points.position[index]));
    let turn = ruling.turn(seed);
    let sight = look(task, (receiver, &aim), (&frame, &turn), (ruling, seed), desk, last);
    if !matches!(sight, Sight::Sampled) {
        ruling.fill(&mut desk.lines, &frame, &turn, seed);
    }
    let emitter = Emitter::new(&aim);
    let [visible, all] = weights::sums(&desk.lines, (&frame, &turn), &aim, (&emitter, receiver.normal));
    let visible = match sight {
        Sight::Lit => all,
        Sight::Hidden => 0.0,
        Sight::Sampled => visible,
    };
    let inside = f64::from(desk.lines.inside().iter().sum::<u32>()).max(1.0);
    let scale = emitter.size / inside;
    let ratio = if all > 0.0 { visible / all } else { 0.0 };
    [(visible * scale) as f32, (all * scale) as f32, ratio as f32]
}

#[inline(always)]
fn point(
    task: &Task,
    rulings: &Rulings,
    (receiver, points, index): (&Receiver, &Points, usize),
    desk: &mut Desk,
    last: &mut usize,
) -> PointTruth {
    let Some(aim) = Aim::new(task.light, receiver) else { return PointTruth::exact(1.0, false) };
    let elevation = aim.elevation(receiver.normal);
    let facing = elevation == Elevation::Above;
    if elevation == Elevation::Below {
        return PointTruth::exact(0.0, false);
    }
    let seed = seed(task.seed, points.position[index]);
    let Some(frame) = Frame::new(receiver, &aim) else {
        // A light without a size, or seen edge-on: the samples of the other ways.
        return task.point(points, index, &mut desk.scratch);
    };
    let mut truth = PointTruth::exact(1.0, facing);
    let sets = std::iter::once(&rulings.mean).chain(rulings.basis.as_ref());
    for (set, ruling) in sets.enumerate() {
        let seed = mix(seed ^ set as u64);
        let turn = ruling.turn(seed);
        match look(task, (receiver, &aim), (&frame, &turn), (ruling, seed), desk, last) {
            Sight::Lit => return PointTruth::exact(1.0, facing),
            Sight::Hidden => return PointTruth::exact(0.0, facing),
            Sight::Sampled if set == 0 => truth = PointTruth { facing, ..mean(&desk.lines) },
            Sight::Sampled => truth.basis = share(&desk.lines, 0..REPLICATES) as f32,
        }
    }
    truth
}

/// The visible part of the samples of some replicates.
#[inline(always)]
fn share(lines: &Lines, lanes: Range<usize>) -> f64 {
    let sum = |counts: [u32; REPLICATES]| f64::from(counts[lanes.clone()].iter().sum::<u32>());
    sum(lines.visible()) / sum(lines.inside()).max(1.0)
}

#[inline(always)]
fn mean(lines: &Lines) -> PointTruth {
    let halves = [share(lines, 0..REPLICATES / 2), share(lines, REPLICATES / 2..REPLICATES)];
    let all = share(lines, 0..REPLICATES);
    let (visible, inside) = (lines.visible(), lines.inside());
    let k = REPLICATES as f64;
    // Of a ratio: the residuals of each replicate against the common share (Cochran 1977, 6.4).
    let average = f64::from(inside.iter().sum::<u32>()) / k;
    let squares: f64 =
        std::iter::zip(visible, inside).map(|(v, n)| (f64::from(v) - all * f64::from(n)).powi(2)).sum();
    PointTruth {
        halves: halves.map(|h| h as f32),
        basis: 0.0,
        mean: (0.5 * (halves[0] + halves[1])) as f32,
        variance: (squares / (k * (k - 1.0) * (average * average).max(1.0))) as f32,
        facing: true,
    }
}

/// Covers what is hidden. Lit and hidden are exact: nothing is between, or one triangle is before the
/// whole light.
#[inline(always)]
fn look(
    task: &Task,
    (receiver, aim): (&Receiver, &Aim),
    (frame, turn): (&Frame, &Turn),
    (ruling, seed): (&Ruling, u64),
    desk: &mut Desk,
    last: &mut usize,
) -> Sight {
    let surfaces = &task.tracer.surfaces;
    let lines = &mut desk.lines;
    let mut drawn = false;
    if aim.elevation(receiver.normal) == Elevation::Across {
        ruling.fill(lines, frame, turn, seed);
        drawn = true;
        let [a, b, c] = frame.form(-receiver.normal);
        let mut below = Outline::new();
        below.add(turn, Edge { a, b, c });
        below.cover(lines, frame);
    }
    if task.settings.method == Method::ScanlineRays {
        if !drawn {
            ruling.fill(lines, frame, turn, seed);
        }
        let hidden = |samples: &LightSamples| rays::blocked(surfaces, (receiver, aim), samples, 0);
        lines.trace((frame, turn, aim), &mut desk.samples, hidden);
        return Sight::Sampled;
    }
    // What hides the whole light comes before any sample, first of all the block that hid it from the
    // neighbour.
    let blocks = &desk.blocks;
    desk.surveys.clear();
    let count = blocks.blocks.len();
    let first = if *last < count { *last } else { 0 };
    for step in 0..=blocks.eights() {
        let (eight, mut between) = match step {
            0 => (first / LANES, u32::from(count > 0) << (first % LANES)),
            _ => (step - 1, blocks.between(frame, step - 1)),
        };
        while between != 0 {
            let at = eight * LANES + between.trailing_zeros() as usize;
            between &= between - 1;
            if step > 0 && at == first {
                continue;
            }
            let block = &blocks.blocks[at];
            let mut survey = block.survey(frame);
            let mut doubtful = survey.doubtful;
            while doubtful != 0 {
                let lane = doubtful.trailing_zeros() as usize;
                doubtful &= doubtful - 1;
                if receiver.skips(block.slots[lane], &block.triangle(lane)) {
                    survey.some &= !(1 << lane);
                }
            }
            if survey.some & survey.whole != 0 {
                *last = at;
                return Sight::Hidden;
            }
            if survey.some != 0 {
                desk.surveys.push((at, survey));
            }
        }
    }
    if desk.surveys.is_empty() {
        return if drawn { Sight::Sampled } else { Sight::Lit };
    }
    if !drawn {
        ruling.fill(lines, frame, turn, seed);
    }
    for (at, survey) in &desk.surveys {
        let sides = survey.sides(frame, ruling, turn);
        let mut some = survey.some;
        while some != 0 {
            let lane = some.trailing_zeros() as usize;
            some &= some - 1;
            let straddles = survey.straddle >> lane & 1 != 0;
            if straddles && !frame.flat {
                let slot = blocks.blocks[*at].slots[lane];
                lines.trace((frame, turn, aim), &mut desk.samples, |samples| {
                    rays::crosses(surfaces, (receiver, aim), samples, slot)
                });
                continue;
            }
            if straddles || sides.open >> lane & 1 != 0 {
                let mut outline = Outline::new();
                for edge in survey.edges(lane) {
                    outline.add(turn, edge);
                }
                if straddles {
                    outline.add(turn, survey.nearer(lane, frame.depth[0]));
                }
                outline.cover(lines, frame);
            } else {
                outline::cover(&sides, lane, lines, frame);
            }
        }
        if lines.full() {
            *last = *at;
            break;
        }
    }
    Sight::Sampled
}
