//! Cut-out triangles before a light: what each covers, less where it is not there.
//!
//! A function of its own, compiled for wide registers by itself: scenes without masks never come here,
//! and their code stays as it is.

use super::eight::LANES;
use super::frame::{Frame, Turn};
use super::groups::Desk;
use super::lines::{Lines, REPLICATES, Ruling};
use super::look::{cover, leave_own};
use crate::aim::Aim;
use crate::cutouts::{Cutouts, Pattern};
use crate::receiver::Receiver;
use crate::truth::{Sight, Task};
use pulp::{Simd, WithSimd};

/// What whole surfaces leave of the light, seen through the cut-out ones.
pub(super) struct Veil<'a> {
    pub(super) task: &'a Task<'a>,
    pub(super) cutouts: &'a Cutouts,
    pub(super) receiver: &'a Receiver,
    pub(super) aim: &'a Aim,
    pub(super) frame: &'a Frame,
    pub(super) turn: &'a Turn,
    pub(super) ruling: &'a Ruling,
    pub(super) seed: u64,
    pub(super) desk: &'a mut Desk,
    /// Lit: no lines are drawn yet.
    pub(super) sight: Sight,
}

impl WithSimd for Veil<'_> {
    type Output = Sight;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Sight {
        let Self { task, cutouts, receiver, aim, frame, turn, ruling, seed, desk, mut sight } = self;
        let surfaces = &task.tracer.surfaces;
        if matches!(sight, Sight::Sampled) && desk.lines.full() {
            return sight;
        }
        for eight in 0..desk.cards.eights() {
            let mut between = desk.cards.between(frame, eight);
            while between != 0 {
                let at = eight * LANES + between.trailing_zeros() as usize;
                between &= between - 1;
                let block = desk.cards.blocks[at];
                let mut survey = block.survey(frame);
                leave_own(&mut survey, &block, receiver);
                if survey.some == 0 {
                    continue;
                }
                if matches!(sight, Sight::Lit) {
                    ruling.fill(&mut desk.lines, frame, turn, seed);
                    sight = Sight::Sampled;
                }
                let sides = survey.sides(frame, ruling, turn);
                let mut some = survey.some;
                while some != 0 {
                    let lane = some.trailing_zeros() as usize;
                    some &= some - 1;
                    let slot = block.slots[lane];
                    desk.before.clear();
                    desk.before.extend(desk.lines.rows.iter().map(|row| row.hidden));
                    cover(
                        task,
                        (receiver, aim),
                        (frame, turn),
                        (&survey, &sides, lane, slot),
                        (&mut desk.lines, &mut desk.samples),
                    );
                    let corners = surfaces.corners_f64(slot);
                    if let Some(pattern) = cutouts.pattern(slot, corners, (receiver, aim)) {
                        uncover(&mut desk.lines, &desk.before, (frame, turn), &pattern);
                    }
                }
                if desk.lines.full() {
                    return sight;
                }
            }
        }
        sight
    }
}

/// Shows again what was hidden since `before` where the surface is not there.
#[inline(always)]
fn uncover(
    lines: &mut Lines,
    before: &[[u32; REPLICATES]],
    (frame, turn): (&Frame, &Turn),
    pattern: &Pattern,
) {
    for (row, before) in lines.rows.iter_mut().zip(before) {
        for k in 0..REPLICATES {
            let mut fresh = row.hidden[k] & !before[k] & row.inside[k];
            while fresh != 0 {
                let i = fresh.trailing_zeros();
                fresh &= fresh - 1;
                let along = 2.0 * (i as f32 + row.shift.0[k]) / lines.per_row - 1.0;
                let place = frame.place(turn, along, [row.y.0[k], row.cos.0[k]]);
                row.hidden[k] &= !(u32::from(!pattern.is_there(place)) << i);
            }
        }
    }
}
