//! What one receiver sees of the light.

use super::blocks::{Block, Sides, Survey};
use super::eight::LANES;
use super::frame::{Frame, Turn};
use super::groups::{Desk, PER_RAY};
use super::lines::Lines;
use super::lines::Ruling;
use super::outline::{self, Edge, Outline};
use super::packets::Packet;
use super::patches::Past;
use super::veil::Veil;
use crate::aim::{Aim, Elevation};
use crate::rays;
use crate::receiver::Receiver;
use crate::samples::LightSamples;
use crate::surfaces::Surfaces;
use crate::truth::{Method, Sight, Task};
use pulp::{Arch, Simd, WithSimd};

/// With more triangles than this across a sphere's depths, each of which is asked for every sample, rays are faster.
const STRADDLING: u32 = 64;

/// Covers what is hidden; `again` from the same receiver with another set of samples. Lit and hidden are exact: nothing is between, or one triangle is before the
/// whole light.
pub(super) fn look(
    task: &Task,
    (receiver, aim): (&Receiver, &Aim),
    (frame, turn): (&Frame, &Turn),
    (ruling, seed, again): (&Ruling, u64, bool),
    desk: &mut Desk,
    last: &mut usize,
) -> Sight {
    let sight = Arch::new().dispatch(Look {
        task,
        receiver,
        aim,
        frame,
        turn,
        ruling,
        seed,
        again,
        desk: &mut *desk,
        last,
    });
    match &task.tracer.surfaces.cutouts {
        Some(cutouts) if !desk.asked && !matches!(sight, Sight::Hidden) && desk.cards.eights() > 0 => {
            Arch::new().dispatch(Veil {
                task,
                cutouts,
                receiver,
                aim,
                frame,
                turn,
                ruling,
                seed,
                desk,
                sight,
            })
        }
        _ => sight,
    }
}

/// At surfaces that are whole. Compiled for wide registers by itself.
struct Look<'a> {
    task: &'a Task<'a>,
    receiver: &'a Receiver,
    aim: &'a Aim,
    frame: &'a Frame,
    turn: &'a Turn,
    ruling: &'a Ruling,
    seed: u64,
    again: bool,
    desk: &'a mut Desk,
    last: &'a mut usize,
}

impl WithSimd for Look<'_> {
    type Output = Sight;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Sight {
        let Self { task, receiver, aim, frame, turn, ruling, seed, again, desk, last } = self;
        past_whole(task, (receiver, aim), (frame, turn), (ruling, seed, again), desk, last)
    }
}

/// The same of surfaces that are whole.
#[inline(always)]
fn past_whole(
    task: &Task,
    (receiver, aim): (&Receiver, &Aim),
    (frame, turn): (&Frame, &Turn),
    (ruling, seed, again): (&Ruling, u64, bool),
    desk: &mut Desk,
    last: &mut usize,
) -> Sight {
    let surfaces = &task.tracer.surfaces;
    desk.asked = false;
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
    if desk.crowded {
        if !drawn {
            ruling.fill(lines, frame, turn, seed);
        }
        return by_rays(surfaces, (receiver, aim), (frame, turn), desk);
    }
    // A second set of samples meets the same.
    if !again && whole(receiver, frame, desk, last) {
        return Sight::Hidden;
    }
    let (past, blocks, lines) = (desk.patches.past(), &desk.blocks, &mut desk.lines);
    if matches!(past, Past::Lit) && desk.surveys.is_empty() {
        return if drawn { Sight::Sampled } else { Sight::Lit };
    }
    if !drawn {
        ruling.fill(lines, frame, turn, seed);
    }
    let straddling = |(_, survey): &(usize, Survey)| (survey.some & survey.straddle).count_ones();
    if !frame.flat && desk.surveys.iter().map(straddling).sum::<u32>() > STRADDLING {
        return by_rays(surfaces, (receiver, aim), (frame, turn), desk);
    }
    if matches!(past, Past::Crossed) {
        desk.winding.start(ruling);
        for seen in &desk.patches.seen {
            desk.winding.add(seen, lines, (frame, ruling, turn));
            if desk.winding.steps() > PER_RAY * ruling.samples() {
                return by_rays(surfaces, (receiver, aim), (frame, turn), desk);
            }
        }
        desk.winding.hide(lines, frame);
        if lines.full() {
            return Sight::Sampled;
        }
    }
    desk.straddling.clear();
    for (at, survey) in &desk.surveys {
        let sides = survey.sides(frame, ruling, turn);
        let mut some = survey.some;
        while some != 0 {
            let lane = some.trailing_zeros() as usize;
            some &= some - 1;
            let slot = blocks.blocks[*at].slots[lane];
            if !frame.flat && survey.straddle >> lane & 1 != 0 {
                desk.straddling.push(slot);
                continue;
            }
            let one = (survey, &sides, lane, slot);
            cover(task, (receiver, aim), (frame, turn), one, (&mut *lines, &mut desk.samples));
        }
        if lines.full() {
            *last = *at;
            return Sight::Sampled;
        }
    }
    if !desk.straddling.is_empty() {
        // Which samples are nearer than the triangle depends on the sample.
        let mut packet = Packet::new(surfaces, receiver, Some(&desk.straddling));
        lines.trace_together((frame, turn, aim), (&mut packet, &mut desk.open), &mut desk.samples);
    }
    Sight::Sampled
}

/// By rays in eights, of all samples that are not hidden yet.
#[inline(always)]
fn by_rays(
    surfaces: &Surfaces,
    (receiver, aim): (&Receiver, &Aim),
    (frame, turn): (&Frame, &Turn),
    desk: &mut Desk,
) -> Sight {
    desk.asked = true;
    let mut packet = Packet::new(surfaces, receiver, None);
    desk.lines.trace_together((frame, turn, aim), (&mut packet, &mut desk.open), &mut desk.samples);
    Sight::Sampled
}

/// Looks for what hides the whole light, before any sample; keeps what hides a part of it on the desk.
#[inline(always)]
fn whole(receiver: &Receiver, frame: &Frame, desk: &mut Desk, last: &mut usize) -> bool {
    if matches!(desk.patches.look(receiver, frame), Past::Hidden) {
        return true;
    }
    // First of all the block that hid it from the neighbour.
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
            leave_own(&mut survey, block, receiver);
            if survey.some & survey.whole != 0 {
                *last = at;
                return true;
            }
            if survey.some != 0 {
                desk.surveys.push((at, survey));
            }
        }
    }
    false
}

/// Leaves out the receiver's own triangle and what is in its plane or below its horizon. In place: a
/// survey is a kilobyte.
#[inline(always)]
pub(super) fn leave_own(survey: &mut Survey, block: &Block, receiver: &Receiver) {
    let mut doubtful = survey.doubtful;
    while doubtful != 0 {
        let lane = doubtful.trailing_zeros() as usize;
        doubtful &= doubtful - 1;
        if receiver.skips(block.slots[lane], &block.triangle(lane)) {
            survey.some &= !(1 << lane);
        }
    }
}

/// Hides what is behind one triangle of a survey.
#[inline(always)]
pub(super) fn cover(
    task: &Task,
    (receiver, aim): (&Receiver, &Aim),
    (frame, turn): (&Frame, &Turn),
    (survey, sides, lane, slot): (&Survey, &Sides, usize, u32),
    (lines, samples): (&mut Lines, &mut LightSamples),
) {
    let straddles = survey.straddle >> lane & 1 != 0;
    if straddles && !frame.flat {
        lines.trace((frame, turn, aim), samples, |samples| {
            rays::crosses(&task.tracer.surfaces, (receiver, aim), samples, slot)
        });
        return;
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
        outline::cover(sides, lane, lines, frame);
    }
}
