//! A fingerprint of everything that a true shadow depends on.

use crate::{AreaLight, Scene};
use glam::Vec3;

impl Scene {
    /// Blake3 over the bits of positions, triangles, their materials, the materials' reflectances
    /// and masks (with the places of masked triangles in them), and the lights. Names, titles, notes and paths do not enter: a cached frame is keyed by its
    /// camera, and by its light where a path moves it. The bits of `-0.0` and `0.0` differ.
    pub fn content_hash(&self) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        hasher.update(b"umbrage scene 1");
        count(&mut hasher, self.geometry.positions.len());
        self.geometry.positions.iter().for_each(|&position| vector(&mut hasher, position));
        count(&mut hasher, self.geometry.triangles.len());
        for (triangle, material) in self.geometry.triangles.iter().zip(&self.geometry.material) {
            for index in triangle.iter().chain([material]) {
                hasher.update(&index.to_le_bytes());
            }
        }
        count(&mut hasher, self.materials.len());
        self.materials.iter().for_each(|material| vector(&mut hasher, material.albedo));
        count(&mut hasher, self.lights.len());
        self.lights.iter().for_each(|light| {
            hasher.update(&light.content_hash());
        });
        self.hash_masks(&mut hasher);
        *hasher.finalize().as_bytes()
    }

    /// Nothing where nothing is cut out: hashes of whole scenes stay what they were.
    fn hash_masks(&self, hasher: &mut blake3::Hasher) {
        if !self.has_masks() {
            return;
        }
        for material in &self.materials {
            let Some(mask) = &material.mask else {
                hasher.update(&[0]);
                continue;
            };
            hasher.update(&[1, mask.wrap()[0] as u8, mask.wrap()[1] as u8]);
            for word in mask.size().iter().chain(mask.bits()) {
                hasher.update(&word.to_le_bytes());
            }
        }
        for (uvs, &material) in self.geometry.uvs.iter().zip(&self.geometry.material) {
            if self.materials[material as usize].mask.is_some() {
                for component in uvs.iter().flat_map(|uv| uv.to_array()) {
                    hasher.update(&component.to_le_bytes());
                }
            }
        }
    }
}

impl AreaLight {
    /// Blake3 over the kind and the bits of its numbers.
    pub fn content_hash(&self) -> [u8; 32] {
        let mut hasher = blake3::Hasher::new();
        let (kind, vectors, number) = match *self {
            Self::Sun { direction_to_light, angular_diameter_radians } => {
                (0u8, [direction_to_light, Vec3::ZERO, Vec3::ZERO], angular_diameter_radians)
            }
            Self::Disk { centre, normal, radius_world } => (1, [centre, normal, Vec3::ZERO], radius_world),
            Self::Rect { centre, half_u, half_v } => (2, [centre, half_u, half_v], 0.0),
            Self::Sphere { centre, radius_world } => (3, [centre, Vec3::ZERO, Vec3::ZERO], radius_world),
        };
        hasher.update(&[kind]);
        vectors.into_iter().for_each(|v| vector(&mut hasher, v));
        hasher.update(&number.to_le_bytes());
        *hasher.finalize().as_bytes()
    }
}

/// Lengths enter so that no element can be taken for one of the next list.
fn count(hasher: &mut blake3::Hasher, length: usize) {
    hasher.update(&(length as u64).to_le_bytes());
}

fn vector(hasher: &mut blake3::Hasher, v: Vec3) {
    for component in v.to_array() {
        hasher.update(&component.to_le_bytes());
    }
}
