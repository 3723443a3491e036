//! Way 1, the arbiter: one any-hit ray for each sample, nothing shared, nothing clever.

use crate::aim::{Aim, Distance, Spread};
use crate::receiver::Receiver;
use crate::samples::LightSamples;
use crate::surfaces::{Line, Surfaces};

/// The last part of the way to a light that has a place belongs to the light: a lamp modelled where
/// the light is does not shadow it. 0.1 mm in a metre, far above f32's rounding of coordinates.
pub(crate) const LIGHT_GAP: f64 = 1e-4;

/// Marks each sample that is not covered yet and that a surface hides: `cover` becomes 1.
pub(crate) fn cover(
    surfaces: &Surfaces,
    sight: (&Receiver, &Aim),
    samples: &LightSamples,
    cover: &mut [f32],
) {
    for (sample, cover) in cover.iter_mut().enumerate() {
        if *cover < 0.0 && blocked(surfaces, sight, samples, sample) {
            *cover = 1.0;
        }
    }
}

/// Whether a surface hides one sample.
pub(crate) fn blocked(
    surfaces: &Surfaces,
    (receiver, aim): (&Receiver, &Aim),
    samples: &LightSamples,
    sample: usize,
) -> bool {
    let line = line(receiver, aim, samples, sample);
    surfaces.blocked(&line, |slot, corners| receiver.skips(slot, corners))
}

/// Whether one surface hides one sample.
pub(crate) fn crosses(
    surfaces: &Surfaces,
    (receiver, aim): (&Receiver, &Aim),
    samples: &LightSamples,
    slot: u32,
) -> bool {
    let line = line(receiver, aim, samples, 0);
    surfaces.crosses(&line, slot)
}

/// From the receiver to a sample.
pub(crate) fn line(receiver: &Receiver, aim: &Aim, samples: &LightSamples, sample: usize) -> Line {
    let to_light = samples.direction(aim, sample);
    let length = to_light.length();
    let end = match aim.spread {
        Spread::Cone { distance: Distance::Infinite, .. } => f64::INFINITY,
        _ => length / f64::from(samples.nearness[sample]) * (1.0 - LIGHT_GAP),
    };
    Line { origin: receiver.position, direction: to_light / length, range: [0.0, end] }
}
