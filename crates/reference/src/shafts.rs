//! Way 2: gather the triangles between a receiver and the light, then test all samples at once
//! (GROUND_TRUTH, section 0).
//!
//! The same samples as the rays, and the same answer but for samples within rounding of a
//! silhouette. Where nothing is between, or one triangle hides the whole light, the answer is exact
//! and no sample is drawn.

mod forms;
mod shaft;

use crate::aim::Aim;
use crate::receiver::Receiver;
use crate::samples::LightSamples;
use crate::surfaces::Surfaces;
use forms::{Shade, Silhouette};
use shaft::Shaft;

/// With more silhouettes than this in the way, rays to the same samples are faster: each rejects all
/// but a few triangles. On the colonnade and on Crytek Sponza 100 and 2000 both take longer.
const MOST: usize = 400;

/// What is between a receiver and the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Between {
    Nothing,
    /// One triangle hides the whole light.
    Everything,
    /// `Scratch` holds the silhouettes.
    Some,
    TooMany,
}

/// What a thread keeps from receiver to receiver.
#[derive(Default)]
pub(crate) struct Scratch {
    open: Vec<u32>,
    silhouettes: Vec<Silhouette>,
    /// Of cut-out triangles, with their slots.
    cards: Vec<(Silhouette, u32)>,
}

/// Walks the tree with the shaft from the receiver to the light.
pub(crate) fn gather(surfaces: &Surfaces, receiver: &Receiver, aim: &Aim, scratch: &mut Scratch) -> Between {
    scratch.silhouettes.clear();
    scratch.cards.clear();
    scratch.open.clear();
    let shaft = Shaft::new(receiver, aim, surfaces.extent);
    let nodes = &surfaces.bvh.nodes;
    scratch.open.push(0);
    while let Some(index) = scratch.open.pop() {
        let node = &nodes[index as usize];
        if !shaft.touches(node.aabb()) {
            continue;
        }
        let first = node.first_index;
        if !node.is_leaf() {
            scratch.open.extend([first, first + 1]);
            continue;
        }
        for slot in first..first + node.prim_count {
            let corners = &surfaces.corners[slot as usize];
            if shaft.misses(corners) || receiver.skips(slot, corners) {
                continue;
            }
            match forms::shade(receiver, aim, surfaces.corners_f64(slot)) {
                Shade::None => {}
                Shade::Whole if surfaces.is_cut(slot) => scratch.cards.push((Silhouette::default(), slot)),
                Shade::Part(silhouette) if surfaces.is_cut(slot) => scratch.cards.push((silhouette, slot)),
                Shade::Whole => return Between::Everything,
                Shade::Part(silhouette) => scratch.silhouettes.push(silhouette),
            }
        }
        if scratch.silhouettes.len() + scratch.cards.len() > MOST {
            return Between::TooMany;
        }
    }
    let nothing = scratch.silhouettes.is_empty() && scratch.cards.is_empty();
    if nothing { Between::Nothing } else { Between::Some }
}

/// Raises `cover` to 0 or above where a silhouette hides the sample.
pub(crate) fn cover(
    surfaces: &Surfaces,
    sight: (&Receiver, &Aim),
    (scratch, samples): (&Scratch, &LightSamples),
    cover: &mut [f32],
) {
    for (done, silhouette) in scratch.silhouettes.iter().enumerate() {
        silhouette.cover(samples, cover);
        if done % 8 == 7 && cover.iter().all(|&c| c >= 0.0) {
            return;
        }
    }
    for (silhouette, slot) in &scratch.cards {
        let cutouts = surfaces.cutouts.as_ref();
        if let Some(pattern) = cutouts.and_then(|c| c.pattern(*slot, surfaces.corners_f64(*slot), sight)) {
            silhouette.cover_where(samples, cover, |place| pattern.is_there(place));
        }
    }
}
