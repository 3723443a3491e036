//! The exact answer of a row of pixels, and whether it is the one that a ray on its own finds.

use super::tile::{APART, NONE, Place, Tile};
use crate::scanlines::{Eight, LANES};
use crate::surfaces::BOX_END;
use crate::wide::{Wide, Wide3};
use glam::{DVec3, Vec3};

/// Eight pixels.
pub(super) struct Row {
    /// Whether the rest is known to be what a ray on its own finds.
    pub(super) known: [bool; LANES],
    pub(super) depth: [f32; LANES],
    pub(super) position: [Vec3; LANES],
    pub(super) normal: [Vec3; LANES],
}

impl Row {
    /// Of the surfaces that a tile has found. Where it has found none, only `known` means anything.
    #[inline(always)]
    pub(super) fn new(place: &Place, tile: &Tile, row: usize) -> Self {
        let (lines, slots) = (&tile.lines[row], &tile.slot[row]);
        let [mut a, mut b, mut c] = [Wide3::ZERO; 3];
        let mut low = [[0.0; LANES]; 3];
        let mut high = [[0.0; LANES]; 3];
        for k in 0..LANES {
            let slot = if slots[k] == NONE { 0 } else { slots[k] };
            let corners = &place.surfaces.corners[slot as usize];
            a.set(k, corners[0].as_dvec3());
            b.set(k, corners[1].as_dvec3());
            c.set(k, corners[2].as_dvec3());
            let least = corners[0].min(corners[1]).min(corners[2]);
            let most = corners[0].max(corners[1]).max(corners[2]);
            for axis in 0..3 {
                low[axis][k] = least[axis];
                high[axis][k] = most[axis];
            }
        }
        // Operation by operation `surfaces::intersect`.
        let direction = lines.direction;
        let (ab, ac) = (b - a, c - a);
        let p = direction.cross(ac);
        let determinant = ab.dot(p);
        let s = Wide3::all(place.camera.eye) - a;
        let q = s.cross(ab);
        let (u, v) = (s.dot(p) / determinant, direction.dot(q) / determinant);
        let distance = ac.dot(q) / determinant;
        let meets =
            meets_box(place.camera.eye, (direction, lines.far), distance, [low.map(Eight), high.map(Eight)]);
        let normal = ab.cross(ac);
        let scale = Wide::all(1.0) / normal.dot(normal).sqrt();
        let normal = normal * scale;
        let towards = normal.dot(direction);
        let position = Wide3::all(place.camera.eye) + direction * distance;
        let cos = Wide3::all(place.camera.forward).dot(direction);
        let mut found = Self {
            known: [false; LANES],
            depth: [0.0; LANES],
            position: [Vec3::ZERO; LANES],
            normal: [Vec3::ZERO; LANES],
        };
        for k in 0..LANES {
            let inside = determinant.0[k] != 0.0 && u.0[k] >= 0.0 && v.0[k] >= 0.0 && u.0[k] + v.0[k] <= 1.0;
            let counts = distance.0[k] >= lines.near.0[k] && distance.0[k] < lines.far.0[k];
            let off = f64::from(tile.best[row].0[k]) * distance.0[k] - lines.length.0[k];
            let alike = off.abs() <= f64::from(APART) * lines.length.0[k];
            let alone = slots[k] == NONE || inside && counts && alike && meets[k];
            found.known[k] = alone && !tile.doubt[row][k];
            found.depth[k] = (distance.0[k] * cos.0[k]) as f32;
            found.position[k] = position.lane(k).as_vec3();
            // As `Tracer::normal_towards`.
            found.normal[k] = match normal.lane(k) {
                _ if !(scale.0[k].is_finite() && scale.0[k] > 0.0) => Vec3::ZERO,
                normal if towards.0[k] > 0.0 => (-normal).as_vec3(),
                normal => normal.as_vec3(),
            };
        }
        found
    }
}

/// Whether obvhs finds each triangle, given its bounds. It looks into a leaf only if the f32 test of its box, and of
/// each box around that, says so; these tests are monotonic in the boxes, so the one with the triangle's own
/// bounds suffices. It is left out if its box begins behind what has been found before: that is farther than this
/// by nearly [`APART`], or is the far plane.
#[inline(always)]
fn meets_box(
    eye: DVec3,
    (direction, far): (Wide3, Wide),
    distance: Wide,
    [low, high]: [[Eight; 3]; 2],
) -> [bool; LANES] {
    let mut first = Eight::all(f32::NEG_INFINITY);
    let mut last = Eight::all(f32::INFINITY);
    for (axis, along) in [direction.x, direction.y, direction.z].into_iter().enumerate() {
        let origin = Eight::all(eye[axis] as f32);
        let mut inverse = Eight::all(0.0);
        for k in 0..LANES {
            // As `Line::boxes` and `obvhs::ray::safe_inverse`.
            let along = along.0[k] as f32 + 0.0;
            let small = along.abs() <= f32::EPSILON;
            inverse.0[k] = if small { 1f32.copysign(along) / f32::EPSILON } else { 1.0 / along };
        }
        let (one, other) = ((low[axis] - origin) * inverse, (high[axis] - origin) * inverse);
        first = first.max(one.min(other));
        last = last.min(one.max(other));
    }
    let mut out = [false; LANES];
    for (k, meets) in out.iter_mut().enumerate() {
        let end = (distance.0[k] * (1.0 + 0.5 * f64::from(APART))) as f32;
        let end = end.min((far.0[k] * BOX_END) as f32);
        *meets = last.0[k] >= first.0[k] && last.0[k] >= 0.0 && first.0[k] < end;
    }
    out
}
