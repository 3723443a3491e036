//! Cut-out surfaces: whether one is there at a place on it.
//!
//! One bit of its mask decides (`umbrage_scene::AlphaMask`): at a hit's barycentric place for rays, and
//! for shafts and scanlines at the sample's, where both agree to f64's rounding.

use crate::aim::Aim;
use crate::receiver::Receiver;
use glam::{DVec2, DVec3, Vec2};
use umbrage_scene::{AlphaMask, Scene};

/// Triangles that are cut out, by their slot.
pub(crate) struct Cutouts {
    masks: Vec<AlphaMask>,
    /// Slot to card, or [`WHOLE`].
    card_of_slot: Vec<u32>,
    cards: Vec<Card>,
}

/// No card: the triangle is there everywhere.
const WHOLE: u32 = u32::MAX;

/// One triangle's place in a mask.
#[derive(Clone, Copy)]
struct Card {
    mask: u32,
    uvs: [DVec2; 3],
}

/// A mask as one receiver sees it on the light.
///
/// With corners a, b, c relative to the receiver, a direction s meets the plane at the barycentric
/// weights `(b x c).s`, `(c x a).s`, `(a x b).s` over their sum. With `s = axis + x u + y v` these are
/// linear in (x, y), and so are the mask's coordinates times the sum.
pub(crate) struct Pattern<'a> {
    mask: &'a AlphaMask,
    u: [f64; 3],
    v: [f64; 3],
    sum: [f64; 3],
}

impl Cutouts {
    /// `None` where nothing is cut out.
    pub(crate) fn new(scene: &Scene, triangle_of_slot: &[u32]) -> Option<Self> {
        if !scene.has_masks() {
            return None;
        }
        let mut cutouts = Self { masks: Vec::new(), card_of_slot: Vec::new(), cards: Vec::new() };
        let mut numbers = vec![WHOLE; scene.materials.len()];
        for (number, material) in numbers.iter_mut().zip(&scene.materials) {
            if let Some(mask) = &material.mask {
                *number = cutouts.masks.len() as u32;
                cutouts.masks.push(mask.clone());
            }
        }
        for &triangle in triangle_of_slot {
            let mask = numbers[scene.geometry.material[triangle as usize] as usize];
            cutouts.card_of_slot.push(if mask == WHOLE { WHOLE } else { cutouts.cards.len() as u32 });
            if mask != WHOLE {
                let uvs = scene.geometry.uvs.get(triangle as usize).copied().unwrap_or_default();
                cutouts.cards.push(Card { mask, uvs: uvs.map(Vec2::as_dvec2) });
            }
        }
        Some(cutouts)
    }

    fn card(&self, slot: u32) -> Option<(&Card, &AlphaMask)> {
        let card = self.cards.get(self.card_of_slot[slot as usize] as usize)?;
        Some((card, &self.masks[card.mask as usize]))
    }

    /// Whether a triangle is cut out.
    pub(crate) fn has(&self, slot: u32) -> bool {
        self.card_of_slot[slot as usize] != WHOLE
    }

    /// Whether a triangle is there, so far along its first and its second side.
    pub(crate) fn is_there(&self, slot: u32, [along_ab, along_ac]: [f64; 2]) -> bool {
        self.card(slot).is_none_or(|(card, mask)| {
            let [a, b, c] = card.uvs;
            mask.is_opaque(a + along_ab * (b - a) + along_ac * (c - a))
        })
    }

    /// What a receiver sees of a mask; `None` of a triangle that is whole.
    pub(crate) fn pattern(
        &self,
        slot: u32,
        corners: [DVec3; 3],
        (receiver, aim): (&Receiver, &Aim),
    ) -> Option<Pattern<'_>> {
        let (card, mask) = self.card(slot)?;
        let [a, b, c] = corners.map(|v| v - receiver.position);
        let normals = [b.cross(c), c.cross(a), a.cross(b)];
        let weighed = |weights: [f64; 3]| {
            let normal = normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2];
            [aim.u, aim.v, aim.axis].map(|side| normal.dot(side))
        };
        let (u, v) = (weighed(card.uvs.map(|uv| uv.x)), weighed(card.uvs.map(|uv| uv.y)));
        Some(Pattern { mask, u, v, sum: weighed([1.0; 3]) })
    }
}

impl Pattern<'_> {
    /// Whether the surface is there before a sample, given in the aim's coordinates.
    #[inline(always)]
    pub(crate) fn is_there(&self, [x, y]: [f32; 2]) -> bool {
        let (x, y) = (f64::from(x), f64::from(y));
        let at = |[a, b, c]: [f64; 3]| a * x + b * y + c;
        self.mask.is_opaque(DVec2::new(at(self.u), at(self.v)) / at(self.sum))
    }
}
