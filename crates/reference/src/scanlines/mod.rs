//! Way 2 on scanlines: each receiver rasterises what is between into a bit mask of the light
//! (GROUND_TRUTH, section 0).
//!
//! Samples stand on parallel lines across the light, so that a triangle covers one run of bits of
//! each line. Receivers that are near each other share one walk of the tree. A receiver's result is
//! a function of its place alone, but for ties on edges: a longer list of candidates covers the same bits.
#![expect(clippy::needless_range_loop, reason = "a lane is an index into several arrays at once")]

mod blocks;
mod candidates;
mod clip;
mod edges;
mod eight;
mod facing;
mod frame;
mod groups;
mod lines;
mod look;
mod outline;
mod packets;
mod patches;
mod shade;
mod veil;
mod volume;
mod weights;
mod whereabouts;
mod winding;

use crate::Points;
use crate::TruthSettings;
use crate::aim::Elevation;
use crate::irradiance::Emitter;
use crate::owen::mix;
use crate::rays;
use crate::receiver::Receiver;
use crate::samples::seed;
use crate::truth::{MOST_ON_SCANLINES, PointTruth, Sight, Task};
pub(crate) use eight::{Eight, LANES};
pub(crate) use frame::Frame;
pub(crate) use groups::spread;
use groups::{Desk, Find, Hidden, find};
use lines::{Lines, REPLICATES};
pub(crate) use lines::{Ruling, STEP};
use look::look;
pub(crate) use outline::{BEYOND, MARGIN};
use std::ops::Range;
use umbrage_scene::AreaLight;
pub(crate) use volume::{bounds, sides};

/// The truth at all points, in their order.
pub(crate) fn truth(task: &Task, points: &Points) -> Vec<PointTruth> {
    find::<Looking>(task, points, PointTruth::exact(1.0, false))
}

/// E, E0 and R at all points, in their order.
pub(crate) fn irradiance(task: &Task, points: &Points) -> Vec<[f32; 3]> {
    find::<Weighing>(task, points, [0.0; 3])
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

    /// Of both sets.
    fn samples(&self) -> usize {
        self.mean.samples() + self.basis.as_ref().map_or(0, Ruling::samples)
    }
}

/// Finds the truth of a receiver.
struct Looking;

/// Finds E, E0 and R of a receiver, from the samples that the mean of its truth is made of.
struct Weighing;

impl Find for Looking {
    type Found = PointTruth;

    const BELOW: PointTruth = PointTruth::exact(0.0, false);

    const HIDDEN: Option<Hidden<PointTruth>> = Some(|task, receiver, desk| {
        let elevation = desk.aim(task.light, receiver).map(|aim| aim.elevation(receiver.normal));
        PointTruth::exact(0.0, elevation == Some(Elevation::Above))
    });

    #[inline(always)]
    fn find(
        task: &Task,
        rulings: &Rulings,
        (receiver, points, index): (&Receiver, &Points, usize),
        desk: &mut Desk,
        last: &mut usize,
    ) -> PointTruth {
        let Some(aim) = desk.aim(task.light, receiver) else { return PointTruth::exact(1.0, false) };
        let elevation = aim.elevation(receiver.normal);
        let facing = elevation == Elevation::Above;
        if elevation == Elevation::Below {
            return PointTruth::exact(0.0, false);
        }
        let seed = seed(task.seed, points.position[index]);
        if aim.is_point() {
            desk.samples.set_place(&aim, [0.0; 2]);
            let blocked = rays::blocked(&task.tracer.surfaces, (receiver, &aim), &desk.samples, 0);
            return PointTruth::exact(if blocked { 0.0 } else { 1.0 }, facing);
        }
        let Some(frame) = desk.frame(receiver, &aim) else {
            // A line of light, or seen edge-on: the samples of the other ways.
            return task.point(points, index, &mut desk.scratch);
        };
        let mut truth = PointTruth::exact(1.0, facing);
        let sets = std::iter::once(&rulings.mean).chain(rulings.basis.as_ref());
        for (set, ruling) in sets.enumerate() {
            let seed = mix(seed ^ set as u64);
            let turn = ruling.turn(seed);
            match look(task, (receiver, &aim), (&frame, &turn), (ruling, seed, set > 0), desk, last) {
                Sight::Lit => return PointTruth::exact(1.0, facing),
                Sight::Hidden => return PointTruth::exact(0.0, facing),
                Sight::Sampled if set == 0 => truth = PointTruth { facing, ..mean(&desk.lines) },
                Sight::Sampled => {
                    truth.basis = share(&desk.lines.visible(), &desk.lines.inside(), 0..REPLICATES) as f32;
                }
            }
        }
        truth
    }
}

impl Find for Weighing {
    type Found = [f32; 3];

    const BELOW: [f32; 3] = [0.0; 3];

    #[inline(always)]
    fn find(
        task: &Task,
        rulings: &Rulings,
        (receiver, points, index): (&Receiver, &Points, usize),
        desk: &mut Desk,
        last: &mut usize,
    ) -> [f32; 3] {
        let Some(aim) = desk.aim(task.light, receiver) else { return [0.0; 3] };
        if aim.elevation(receiver.normal) == Elevation::Below {
            return [0.0; 3];
        }
        let Some(frame) = desk.frame(receiver, &aim) else {
            return task.irradiance(points, index, &mut desk.scratch);
        };
        let ruling = &rulings.mean;
        let seed = mix(seed(task.seed, points.position[index]));
        let turn = ruling.turn(seed);
        let sight = look(task, (receiver, &aim), (&frame, &turn), (ruling, seed, false), desk, last);
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
}

/// The visible part of the samples of some replicates.
#[inline(always)]
fn share(visible: &[u32; REPLICATES], inside: &[u32; REPLICATES], lanes: Range<usize>) -> f64 {
    let sum = |counts: &[u32; REPLICATES]| f64::from(counts[lanes.clone()].iter().sum::<u32>());
    sum(visible) / sum(inside).max(1.0)
}

#[inline(always)]
fn mean(lines: &Lines) -> PointTruth {
    let (visible, inside) = (lines.visible(), lines.inside());
    let share = |lanes| share(&visible, &inside, lanes);
    let halves = [share(0..REPLICATES / 2), share(REPLICATES / 2..REPLICATES)];
    let all = share(0..REPLICATES);
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
